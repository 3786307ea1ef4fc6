#include "render/plot.h"

#include <cmath>
#include <set>

#include "base/parallel_range.h"
#include "render/font.h"
#include "render/outline.h"
#include "render/palette.h"

namespace seiche::render {
namespace {

const Vec3f ink{0.05f, 0.06f, 0.08f};

// Maps between world and pixel coordinates of a plot.
struct Mapping {
  std::array<int, 4> rectangle;
  Vec2f lower;
  Vec2f pixel;  // m a pixel along x and y

  Vec3f world(float x, float y) const {
    return {lower.x() + (x - float(rectangle[0])) * pixel.x(), lower.y() + (float(rectangle[3]) - y) * pixel.y(), 0};
  }
  Vec2f picture(const Vec2f& x) const {
    return {float(rectangle[0]) + (x.x() - lower.x()) / pixel.x(),
            float(rectangle[3]) - (x.y() - lower.y()) / pixel.y()};
  }
};

Mapping map_domain(const Box& domain, int width, int height) {
  Mapping map{plot_rectangle(domain, width, height), domain.lower.head<2>(), {1, 1}};
  map.pixel.x() = domain.size()[0] / float(map.rectangle[2] - map.rectangle[0]);
  map.pixel.y() = domain.size()[1] / float(map.rectangle[3] - map.rectangle[1]);
  return map;
}

void paint_liquid(Canvas& canvas, const Plot& plot, const Mapping& map) {
  const Vec3f blue = from_srgb(0.20f, 0.47f, 0.74f);
  parallel_range(map.rectangle[1], map.rectangle[3], [&](int y) {
    for (int x = map.rectangle[0]; x < map.rectangle[2]; ++x) {
      Vec3f at = map.world(float(x) + 0.5f, float(y) + 0.5f);
      at[2] = plot.phi.lower[2] + 0.5f * plot.phi.h;
      const float phi = plot.phi.sample(at);
      const float cover = std::clamp(0.5f - phi / map.pixel.x(), 0.0f, 1.0f);
      if (cover <= 0) continue;
      blend(canvas, x, y, plot.quantity ? color_of(plot.scale, plot.quantity->sample(at)) : blue, cover);
    }
  });
}

void paint_solids(Canvas& canvas, const Plot& plot, const Mapping& map) {
  const auto& [x0, y0, x1, y1] = map.rectangle;
  for (const int solid : std::set<int>(plot.solids.solid.begin(), plot.solids.solid.end())) {
    auto polygons = close_outlines(plot.solids, solid, plot.domain);
    for (Polygon& polygon : polygons) {
      for (Vec2f& x : polygon) x = map.picture(x);
    }
    const Vec3f color = solid_color(plot.colors, solid);
    for (int y = y0; y < y1; ++y) {
      const auto cover = row_coverage(polygons, x0, x1 - x0, y);
      for (int x = x0; x < x1; ++x) blend(canvas, x, y, color, cover[x - x0]);
    }
  }
}

void draw_axes(Canvas& canvas, const Plot& plot, const Mapping& map, int font) {
  const auto [x0, y0, x1, y1] = map.rectangle;
  for (const auto& side : {std::array<int, 4>{x0 - 1, y0 - 1, x1 + 1, y0},
                           {x0 - 1, y1, x1 + 1, y1 + 1},
                           {x0 - 1, y0, x0, y1},
                           {x1, y0, x1 + 1, y1}}) {
    fill(canvas, side, ink, 1);
  }
  for (int a = 0; a < 2; ++a) {
    const double low = plot.domain.lower[a], high = plot.domain.upper[a];
    const int room = a == 0 ? (x1 - x0) / (45 * font) : (y1 - y0) / (25 * font);
    const double step = tick_step(high - low, std::clamp(room, 1, 8));
    for (double tick = std::ceil(low / step - 1e-6) * step; tick <= high + 1e-6 * step; tick += step) {
      Vec2f at = plot.domain.lower.head<2>();
      at[a] = float(tick);
      const Vec2f p = map.picture(at);
      const int x = int(std::lround(p.x())), y = int(std::lround(p.y()));
      if (a == 0) fill(canvas, {x, y, x + 1, y + 3 * font}, ink, 1);
      if (a == 0) draw_text(canvas, x, y + 5 * font, tick_text(tick, step), font, ink, Anchor::middle);
      if (a == 1) fill(canvas, {x - 3 * font, y, x, y + 1}, ink, 1);
      if (a == 1) draw_text(canvas, x - 5 * font, y - 3 * font, tick_text(tick, step), font, ink, Anchor::end);
    }
  }
  draw_text(canvas, (x0 + x1) / 2, y1 + 15 * font, "x (m)", font, ink, Anchor::middle);
  draw_text(canvas, x0 - 6 * font, y0 - 11 * font, "y (m)", font, ink, Anchor::middle);
}

}  // namespace

std::array<int, 4> plot_rectangle(const Box& domain, int width, int height) {
  const int font = font_scale(height);
  const int low_x = 46 * font, high_x = width - 66 * font, low_y = 30 * font, high_y = height - 28 * font;
  const float fit = std::min(float(high_x - low_x) / domain.size()[0], float(high_y - low_y) / domain.size()[1]);
  const int w = std::max(1, int(std::lround(domain.size()[0] * fit)));
  const int h = std::max(1, int(std::lround(domain.size()[1] * fit)));
  const int x0 = low_x + (high_x - low_x - w) / 2, y0 = low_y + (high_y - low_y - h) / 2;
  return {x0, y0, x0 + w, y0 + h};
}

Canvas plot_picture(const Plot& plot, int width, int height) {
  Canvas canvas(width, height, Vec3f::Constant(0.97f));
  const Mapping map = map_domain(plot.domain, width, height);
  const auto [x0, y0, x1, y1] = map.rectangle;
  fill(canvas, map.rectangle, Vec3f::Ones(), 1);
  paint_liquid(canvas, plot, map);
  paint_solids(canvas, plot, map);
  const int font = font_scale(height);
  draw_axes(canvas, plot, map, font);
  if (plot.quantity) draw_color_bar(canvas, {x1 + 8 * font, y0, x1 + 18 * font, y1}, plot.scale, font, ink);
  return canvas;
}

}  // namespace seiche::render
