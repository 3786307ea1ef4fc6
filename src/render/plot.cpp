#include "render/plot.h"

#include <cmath>
#include <set>

#include "base/parallel_range.h"
#include "render/font.h"
#include "render/outline.h"
#include "render/palette.h"

namespace seiche::render {
namespace {

constexpr float bar_width = 1.0f;  // of the colour bar, in text sizes

PlotStyle style_of(const Painter& painter) {
  return {text_size(painter.width(), painter.height())};
}

// Maps m to pixels.
struct Mapping {
  std::array<float, 4> rectangle;
  Vec2f lower;
  float pixels;  // a m

  Vec2f picture(const Vec2f& x) const {
    return {rectangle[0] + (x.x() - lower.x()) * pixels, rectangle[3] - (x.y() - lower.y()) * pixels};
  }
  std::vector<Polygon> picture(std::vector<Polygon> polygons) const {
    for (Polygon& polygon : polygons)
      for (Vec2f& x : polygon) x = picture(x);
    return polygons;
  }
  std::vector<Polygon> border() const {
    const auto& [x0, y0, x1, y1] = rectangle;
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  }
};

// Colours of the quantity over the rectangle: a sample a pixel.
Image colors_of(const Plot& plot, const Mapping& map) {
  const auto& [x0, y0, x1, y1] = map.rectangle;
  Canvas canvas(std::max(1, int(std::lround(x1 - x0))), std::max(1, int(std::lround(y1 - y0))), Vec3f::Zero());
  const Vec3f size = plot.domain.size();
  parallel_range(0, canvas.height, [&](int y) {
    for (int x = 0; x < canvas.width; ++x) {
      const Vec3f at(plot.domain.lower[0] + (float(x) + 0.5f) / float(canvas.width) * size[0],
                     plot.domain.upper[1] - (float(y) + 0.5f) / float(canvas.height) * size[1],
                     plot.quantity->lower[2] + 0.5f * plot.quantity->h);
      canvas.at(x, y) = color_of(plot.scale, plot.quantity->sample(at));
    }
  });
  return to_image(canvas);
}

void draw_liquid(Painter& painter, const Plot& plot, const Mapping& map) {
  const std::vector<Polygon> outlines = map.picture(liquid_outlines(plot.phi));
  if (outlines.empty()) return;
  if (!plot.quantity) return painter.fill(outlines, plot.liquid);
  const std::array<float, 4>& r = map.rectangle;
  painter.within(outlines, [&] { painter.picture(colors_of(plot, map), r[0], r[1], r[2], r[3]); });
}

void draw_solids(Painter& painter, const Plot& plot, const Mapping& map) {
  for (const int solid : std::set<int>(plot.solids.solid.begin(), plot.solids.solid.end())) {
    painter.fill(map.picture(close_outlines(plot.solids, solid, plot.domain)), solid_color(plot.colors, solid));
  }
}

// A head in the middle of a streamline, in the direction of the flow.
Polygon arrow_head(const Polygon& line, float size) {
  const std::size_t middle = line.size() / 2;
  const Vec2f along = (line[middle] - line[middle - 1]).normalized(), side(-along.y(), along.x());
  return {line[middle] + 0.5f * size * along, line[middle] - 0.5f * size * along + 0.35f * size * side,
          line[middle] - 0.5f * size * along - 0.35f * size * side};
}

void draw_streamlines(Painter& painter, const Plot& plot, const Mapping& map, const PlotStyle& style) {
  for (const Polygon& line : map.picture(plot.streamlines)) {
    if (line.size() < 3) continue;
    painter.stroke(line, 2.6f * style.line(), Vec3f::Constant(0.75f));  // apart from dark colours
    painter.stroke(line, style.line(), style.ink);
    painter.fill({arrow_head(line, 0.55f * style.size)}, style.ink);
  }
}

Axis axis_of(const Plot& plot, int axis) {
  return {plot.domain.lower[axis], plot.domain.upper[axis], 0, 1, axis == 0 ? "x (m)" : "y (m)"};
}

// The margins around the domain: left, above, right, below.
std::array<float, 4> margins(const Painter& painter, const Plot& plot, const PlotStyle& style) {
  if (plot.plain) return {0, 0, 0, 0};
  const auto height = float(painter.height());
  std::array<float, 4> sides{room_left(painter, axis_of(plot, 1), height, style) + 0.5f * style.size, 2.6f * style.size,
                             2.2f * style.size, room_below(axis_of(plot, 0), style) + 0.5f * style.size};
  if (plot.quantity) sides[2] = (1.2f + bar_width) * style.size + room_of_color_bar(painter, plot.scale, height, style);
  return sides;
}

}  // namespace

std::array<float, 4> plot_rectangle(const Painter& painter, const Plot& plot) {
  const auto [left, above, right, below] = margins(painter, plot, style_of(painter));
  const float room_x = std::max(8.0f, float(painter.width()) - left - right);
  const float room_y = std::max(8.0f, float(painter.height()) - above - below);
  const Vec3f size = plot.domain.size();
  const float fit = std::min(room_x / size[0], room_y / size[1]);
  const float x0 = std::round(left + 0.5f * (room_x - fit * size[0]));
  const float y0 = std::round(above + 0.5f * (room_y - fit * size[1]));
  return {x0, y0, x0 + fit * size[0], y0 + fit * size[1]};
}

void draw_plot(Painter& painter, const Plot& plot) {
  const PlotStyle style = style_of(painter);
  Mapping map{plot_rectangle(painter, plot), plot.domain.lower.head<2>(), 1};
  const auto [x0, y0, x1, y1] = map.rectangle;
  map.pixels = (x1 - x0) / plot.domain.size()[0];
  if (!plot.plain) painter.rectangle(0, 0, float(painter.width()), float(painter.height()), Vec3f::Constant(0.97f));
  painter.rectangle(x0, y0, x1, y1, Vec3f::Ones());
  painter.within(map.border(), [&] {
    draw_liquid(painter, plot, map);
    for (const Disc& drop : plot.drops) painter.fill(map.picture({drop.outline}), drop.color);
    draw_streamlines(painter, plot, map, style);
    draw_solids(painter, plot, map);
  });
  if (plot.plain) return;
  Axis x = axis_of(plot, 0), y = axis_of(plot, 1);
  x.from = x0, x.to = x1, y.from = y1, y.to = y0;
  draw_frame(painter, x, y, style, false);
  const float bar = x1 + 1.2f * style.size;
  if (plot.quantity) draw_color_bar(painter, {bar, y0, bar + bar_width * style.size, y1}, plot.scale, style);
}

}  // namespace seiche::render
