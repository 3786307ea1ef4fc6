#pragma once
// False colours and the colour bar.
#include <string>

#include "render/image.h"

namespace seiche::render {

// Range of values shown in false colours; `label` gives quantity and unit.
struct ColorScale {
  float low = 0, high = 1;
  std::string label;
};

// From dark violet through blue and green to yellow, with increasing lightness; t is clamped to [0, 1]. Linear light.
Vec3f color_map(float t);

// Colour of a value on the scale.
Vec3f color_of(const ColorScale& scale, float value);

// Round step (1, 2 or 5 times a power of ten) that divides `range` into about `count` parts.
double tick_step(double range, int count);

// The number with the digits that a step of this size needs.
std::string tick_text(double value, double step);

// Draws a vertical bar x0 <= x < x1, y0 <= y < y1 with numbers on its right and its label above.
void draw_color_bar(Canvas& canvas, const std::array<int, 4>& x0y0x1y1, const ColorScale& scale, int font,
                    const Vec3f& ink);

}  // namespace seiche::render
