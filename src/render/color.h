#pragma once
// False colours and the colour bar.
#include <string>

#include "render/image.h"

namespace seiche::render {

// Values from low to high in false colours; `label` names quantity and unit.
struct ColorScale {
  float low = 0, high = 1;
  std::string label;
};

// Dark violet over blue and green to yellow, ever lighter; t in [0, 1] (clamped). Linear light.
Vec3f color_map(float t);

// The colour of a value on the scale.
Vec3f color_of(const ColorScale& scale, float value);

// A round number step (1, 2 or 5 times a power of ten) that divides `range` into about `count` parts.
double tick_step(double range, int count);

// The number with as many digits as a step of this size needs.
std::string tick_text(double value, double step);

// A vertical bar x0 <= x < x1, y0 <= y < y1 with numbers on its high-x side and its label above it.
void draw_color_bar(Canvas& canvas, const std::array<int, 4>& x0y0x1y1, const ColorScale& scale, int font,
                    const Vec3f& ink);

}  // namespace seiche::render
