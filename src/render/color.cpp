#include "render/color.h"

#include <algorithm>
#include <cmath>

namespace seiche::render {
namespace {

int ticks_of_bar(float length, float size) {
  return std::clamp(int(length / (2.8f * size)), 1, 6);
}

}  // namespace

Vec3f color_of(const ColorScale& scale, float value) {
  const float range = scale.high - scale.low;
  return scale.map->at(range > 0 ? (value - scale.low) / range : 0.5f);
}

void draw_color_bar(Painter& painter, const std::array<float, 4>& x0y0x1y1, const ColorScale& scale,
                    const PlotStyle& style) {
  const auto [x0, y0, x1, y1] = x0y0x1y1;
  const float part = (y1 - y0) / float(scale.map->colors.size());
  for (std::size_t i = 0; i < scale.map->colors.size(); ++i) {
    const float low = y1 - float(i) * part;
    // reaches below the next colour, so that no seam shows
    painter.rectangle(x0, std::max(y0, low - 2 * part), x1, low, scale.map->colors[i]);
  }
  painter.stroke({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, style.line(), style.ink, true);
  const Axis axis{scale.low, scale.high, y1, y0, scale.label};
  const auto ticks = ticks_of(axis, ticks_of_bar(y1 - y0, style.size));
  for (const Tick& tick : ticks) {
    const float y = axis.place(tick.value);
    painter.stroke({{x1, y}, {x1 + style.tick(), y}}, style.line(), style.ink);
    painter.text(x1 + 1.6f * style.tick(), y + 0.5f * cap_height(style.size), tick.text, style.size, style.ink);
  }
  const float beyond = x1 + 1.6f * style.tick() + widest(painter, ticks, style.size) + 1.3f * style.size;
  painter.text(beyond, 0.5f * (y0 + y1), scale.label, style.size, style.ink, Anchor::middle, true);
}

float room_of_color_bar(const Painter& painter, const ColorScale& scale, float length, const PlotStyle& style) {
  const Axis axis{scale.low, scale.high, length, 0, ""};
  return 1.6f * style.tick() + widest(painter, ticks_of(axis, ticks_of_bar(length, style.size)), style.size) +
         1.7f * style.size;
}

}  // namespace seiche::render
