#pragma once
// Pictures of 2D frames: liquid in false colours, solids grey, axes, colour bar.
#include <optional>

#include "render/bvh.h"
#include "render/color.h"

namespace seiche::render {

struct Plot {
  Box domain;                            // z is not used
  ScalarVolume phi;                      // level set, one cell thick
  std::optional<ScalarVolume> quantity;  // unset: plain blue
  ColorScale scale;
  SolidMesh solids;           // segments
  std::vector<Vec3f> colors;  // of the solids
};

// The domain as large as fits, to scale, y upwards. The interface is smoothed by the share of each pixel that the level
// set covers.
Canvas plot_picture(const Plot& plot, int width, int height);

// Where the domain lies on that picture: x0, y0, x1, y1 in pixels (y1 is the lower side).
std::array<int, 4> plot_rectangle(const Box& domain, int width, int height);

}  // namespace seiche::render
