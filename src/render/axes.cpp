#include "render/axes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace seiche::render {
namespace {

const Vec3f grid_ink = Vec3f::Constant(0.82f);

// Number of ticks for which numbers along x have room, or lines of numbers along y.
int ticks_along(const Axis& axis, float size, bool along_x) {
  return std::clamp(int(std::abs(axis.to - axis.from) / (size * (along_x ? 4.5f : 2.8f))), 1, 8);
}

// "10⁻⁵", or "1000" for small powers.
std::string power_text(int power) {
  if (std::abs(power) <= 3) return fmt::format("{:g}", std::pow(10.0, power));
  static const std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "10⁻" : "10";
  for (const char digit : fmt::format("{}", std::abs(power))) text += digits[std::size_t(digit - '0')];
  return text;
}

std::vector<Tick> linear_ticks(const Axis& axis, int count) {
  std::vector<Tick> ticks;
  const double step = tick_step(axis.high - axis.low, count);
  const double first = std::ceil(axis.low / step - 1e-6), last = std::floor(axis.high / step + 1e-6);
  if (!std::isfinite(first) || !(last - first < 100)) return ticks;
  for (double n = first; n <= last; ++n) ticks.push_back({n * step, tick_text(n * step, step)});
  return ticks;
}

// Powers of ten; on short axes 1, 2 and 5 times them, or round steps.
std::vector<Tick> logarithmic_ticks(const Axis& axis, int count) {
  const int first = int(std::ceil(std::log10(axis.low) - 1e-9)), last = int(std::floor(std::log10(axis.high) + 1e-9));
  std::vector<Tick> ticks;
  const int stride = std::max(1, (last - first + count) / std::max(1, count));
  for (int power = first; power <= last; power += stride) ticks.push_back({std::pow(10.0, power), power_text(power)});
  if (last - first >= 2) return ticks;
  ticks.clear();
  for (int power = first - 1; power <= last; ++power) {
    for (const int factor : {1, 2, 5}) {
      const double value = factor * std::pow(10.0, power);
      if (value >= axis.low && value <= axis.high) ticks.push_back({value, fmt::format("{:g}", value)});
    }
  }
  return ticks.size() >= 2 ? ticks : linear_ticks(axis, count);
}

// Room between the rectangle and the numbers.
float gap_of(const PlotStyle& style) {
  return style.tick() + 0.35f * style.size;
}

}  // namespace

double tick_step(double range, int count) {
  if (!(range > 0)) return 1;
  const double rough = range / count, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-6 * step) value = 0;
  if (step >= 1e5 || step < 1e-4) {
    const int digits =
        value == 0 ? 1 : int(std::floor(std::log10(std::abs(value)) + 1e-9) - std::floor(std::log10(step) + 1e-9)) + 1;
    return value == 0 ? "0" : fmt::format("{:.{}g}", value, std::clamp(digits, 1, 9));
  }
  return fmt::format("{:.{}f}", value, std::max(0, int(-std::floor(std::log10(step) + 1e-9))));
}

float Axis::place(double value) const {
  const double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return from + float(share) * (to - from);
}

std::vector<Tick> ticks_of(const Axis& axis, int count) {
  return axis.logarithmic ? logarithmic_ticks(axis, count) : linear_ticks(axis, count);
}

float widest(const Painter& painter, const std::vector<Tick>& ticks, float size) {
  float width = 0;
  for (const Tick& tick : ticks) width = std::max(width, painter.text_width(tick.text, size));
  return width;
}

float room_left(const Painter& painter, Axis y, float length, const PlotStyle& style) {
  y.from = length, y.to = 0;
  const float numbers = widest(painter, ticks_of(y, ticks_along(y, style.size, false)), style.size);
  return numbers + gap_of(style) + (y.title.empty() ? 0.4f : 1.7f) * style.size;
}

float room_below(const Axis& x, const PlotStyle& style) {
  return gap_of(style) + (x.title.empty() ? 1.2f : 2.7f) * style.size;
}

void draw_frame(Painter& painter, const Axis& x, const Axis& y, const PlotStyle& style, bool grid) {
  const float size = style.size, line = style.line(), gap = gap_of(style);
  float widest_y = 0;
  for (const Tick& tick : ticks_of(x, ticks_along(x, size, true))) {
    const float at = x.place(tick.value);
    if (grid) painter.stroke({{at, y.from}, {at, y.to}}, line, grid_ink);
    painter.stroke({{at, y.from}, {at, y.from + style.tick()}}, line, style.ink);
    painter.text(at, y.from + gap + cap_height(size), tick.text, size, style.ink, Anchor::middle);
  }
  for (const Tick& tick : ticks_of(y, ticks_along(y, size, false))) {
    const float at = y.place(tick.value);
    if (grid) painter.stroke({{x.from, at}, {x.to, at}}, line, grid_ink);
    painter.stroke({{x.from - style.tick(), at}, {x.from, at}}, line, style.ink);
    painter.text(x.from - gap, at + 0.5f * cap_height(size), tick.text, size, style.ink, Anchor::end);
    widest_y = std::max(widest_y, painter.text_width(tick.text, size));
  }
  painter.stroke({{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}}, line, style.ink, true);
  painter.text(0.5f * (x.from + x.to), y.from + gap + 2.3f * size, x.title, size, style.ink, Anchor::middle);
  painter.text(x.from - gap - widest_y - 0.6f * size, 0.5f * (y.from + y.to), y.title, size, style.ink, Anchor::middle,
               true);
}

}  // namespace seiche::render
