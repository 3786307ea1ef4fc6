#pragma once
// False colours and the colour bar.
#include <string>

#include "render/axes.h"
#include "render/color_maps.h"

namespace seiche::render {

// Range of values shown in false colours; `label` gives quantity and unit.
struct ColorScale {
  float low = 0, high = 1;
  std::string label;
  const ColorMap* map = &color_map("viridis");
};

// Colour of a value on the scale; that of the nearer end beyond it.
Vec3f color_of(const ColorScale& scale, float value);

// Draws a vertical bar over x0 <= x <= x1, y0 <= y <= y1 with numbers on its right and its label, read upwards, beyond
// them.
void draw_color_bar(Painter& painter, const std::array<float, 4>& x0y0x1y1, const ColorScale& scale,
                    const PlotStyle& style);

// Room that the bar's numbers and label take on its right, in pixels, for a bar of that length.
float room_of_color_bar(const Painter& painter, const ColorScale& scale, float length, const PlotStyle& style);

}  // namespace seiche::render
