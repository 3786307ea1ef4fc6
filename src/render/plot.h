#pragma once
// Pictures of 2D frames: liquid in false colours, grey solids, axes, colour bar.
#include <optional>

#include "render/bvh.h"
#include "render/color.h"

namespace seiche::render {

struct Plot {
  Box domain;                            // z is unused
  ScalarVolume phi;                      // level set, one cell thick
  std::optional<ScalarVolume> quantity;  // unset: plain blue
  ColorScale scale;
  SolidMesh solids;           // segments
  std::vector<Vec3f> colors;  // of the solids
};

// The domain at the largest scale that fits, y upwards. The interface is anti-aliased by the level set's coverage of
// each pixel.
Canvas plot_picture(const Plot& plot, int width, int height);

// Rectangle of the domain in that picture: x0, y0, x1, y1 in pixels (y1 is the lower side).
std::array<int, 4> plot_rectangle(const Box& domain, int width, int height);

}  // namespace seiche::render
