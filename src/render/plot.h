#pragma once
// Pictures of 2D frames: liquid in false colours, solids, streamlines, axes, colour bar.
#include <optional>

#include "render/bvh.h"
#include "render/color.h"

namespace seiche::render {

// A drop: its outline (m) and colour.
struct Disc {
  Polygon outline;
  Vec3f color;
};

struct Plot {
  Box domain;                            // z is unused
  ScalarVolume phi;                      // level set, one cell thick
  std::optional<ScalarVolume> quantity;  // unset: the plain colour of the liquid
  ColorScale scale;
  SolidMesh solids;                  // segments
  std::vector<Vec3f> colors;         // of the solids
  std::vector<Polygon> streamlines;  // m
  std::vector<Disc> drops;
  Vec3f liquid = from_srgb(0.20f, 0.47f, 0.74f);
  bool plain = false;  // nothing beside the picture: no axes, no colour bar
};

// The domain at the largest scale that fits, y upwards. The liquid is bounded by the zero contour of its level set, the
// solids by their segments; both are lines, not pixels.
void draw_plot(Painter& painter, const Plot& plot);

// Rectangle of the domain in that picture: x0, y0, x1, y1 in pixels (y1 is the lower side).
std::array<float, 4> plot_rectangle(const Painter& painter, const Plot& plot);

// The liquid as closed outlines, in m: the zero contour of the level set, interpolated by cubic pieces between the
// cells' centres. Beyond the domain they reach a cell.
std::vector<Polygon> liquid_outlines(const ScalarVolume& phi);

}  // namespace seiche::render
