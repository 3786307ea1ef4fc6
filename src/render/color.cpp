#include "render/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/font.h"

namespace seiche::render {
namespace {

// Six sRGB colours of evenly increasing lightness, interpolated by Catmull-Rom curves.
Vec3f map_formula(float t) {
  static const std::array<Vec3f, 6> knots{Vec3f{0.26f, 0.02f, 0.34f}, Vec3f{0.24f, 0.25f, 0.53f},
                                          Vec3f{0.15f, 0.45f, 0.56f}, Vec3f{0.15f, 0.64f, 0.51f},
                                          Vec3f{0.51f, 0.82f, 0.29f}, Vec3f{0.98f, 0.91f, 0.16f}};
  const float s = t * 5;
  const int i = std::clamp(int(s), 0, 4);
  const float u = s - float(i);
  const Vec3f &p1 = knots[i], &p2 = knots[i + 1];
  const Vec3f &p0 = knots[std::max(0, i - 1)], &p3 = knots[std::min(5, i + 2)];
  const Vec3f bend = 2 * p0 - 5 * p1 + 4 * p2 - p3, twist = 3 * (p1 - p2) + p3 - p0;
  const Vec3f c = p1 + 0.5f * u * (p2 - p0 + u * (bend + u * twist));
  return from_srgb(std::clamp(c[0], 0.0f, 1.0f), std::clamp(c[1], 0.0f, 1.0f), std::clamp(c[2], 0.0f, 1.0f));
}

std::array<Vec3f, 257> map_table() {
  std::array<Vec3f, 257> table;
  for (int i = 0; i <= 256; ++i) table[i] = map_formula(float(i) / 256);
  return table;
}

}  // namespace

Vec3f color_map(float t) {
  static const std::array<Vec3f, 257> table = map_table();
  return table[std::size_t(std::clamp(t, 0.0f, 1.0f) * 256 + 0.5f)];
}

Vec3f color_of(const ColorScale& scale, float value) {
  const float range = scale.high - scale.low;
  return color_map(range > 0 ? (value - scale.low) / range : 0.5f);
}

double tick_step(double range, int count) {
  if (!(range > 0)) return 1;
  const double rough = range / count, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-6 * step) value = 0;
  if (step >= 1e5 || step < 1e-4) return fmt::format("{:.2g}", value);
  return fmt::format("{:.{}f}", value, std::max(0, int(-std::floor(std::log10(step) + 1e-9))));
}

void draw_color_bar(Canvas& canvas, const std::array<int, 4>& x0y0x1y1, const ColorScale& scale, int font,
                    const Vec3f& ink) {
  const auto [x0, y0, x1, y1] = x0y0x1y1;
  for (int y = y0; y < y1; ++y) {
    fill(canvas, {x0, y, x1, y + 1}, color_map(1 - (float(y - y0) + 0.5f) / float(y1 - y0)), 1);
  }
  const double range = scale.high - scale.low, step = tick_step(range, 5);
  for (double tick = std::ceil(scale.low / step - 1e-9) * step; tick <= scale.high + 1e-9 * step; tick += step) {
    const int y = y1 - int(std::lround((tick - scale.low) / (range > 0 ? range : 1) * (y1 - y0)));
    fill(canvas, {x1, y, x1 + 2 * font, y + 1}, ink, 1);
    draw_text(canvas, x1 + 4 * font, y - 3 * font, tick_text(tick, step), font, ink);
    if (!(range > 0)) break;
  }
  draw_text(canvas, x0, y0 - 13 * font, scale.label, font, ink);
}

}  // namespace seiche::render
