#include "charts/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/axes.h"
#include "render/font.h"

namespace seiche::charts {
namespace {

using render::Axis;
using render::Painter;
using render::PlotStyle;
using render::Polygon;
using render::Vec3f;

constexpr std::size_t most_labels = 8;  // in a legend

// Distinct for all kinds of colour vision: M. Okabe, K. Ito, Color universal design (2008); black is last.
Vec3f curve_color(std::size_t n) {
  static const std::array<Vec3f, 7> colors{
      render::from_srgb(0.000f, 0.447f, 0.698f), render::from_srgb(0.835f, 0.369f, 0.000f),
      render::from_srgb(0.000f, 0.620f, 0.451f), render::from_srgb(0.800f, 0.475f, 0.655f),
      render::from_srgb(0.902f, 0.624f, 0.000f), render::from_srgb(0.337f, 0.706f, 0.914f),
      render::from_srgb(0.100f, 0.100f, 0.100f)};
  return colors[n % colors.size()];
}

// Solid for the first seven curves, then dashed.
float dash_of(std::size_t n, const PlotStyle& style) {
  return n / 7 % 2 == 1 ? 0.5f * style.size : 0.0f;
}

bool is_shown(const Panel& panel, double value) {
  return std::isfinite(value) && (!panel.logarithmic || value > 0);
}

Range range_of_time(const Panel& panel) {
  Range range{1e300, -1e300};
  for (const Curve& curve : panel.curves)
    for (const double time : curve.time)
      if (std::isfinite(time)) range.low = std::min(range.low, time), range.high = std::max(range.high, time);
  if (!(range.low < range.high)) range = range.low > 1e299 ? Range{0, 1} : Range{range.low - 0.5, range.low + 0.5};
  return range;
}

struct Place {
  float x0, y0, x1, y1;
};

void draw_curve(Painter& painter, const Panel& panel, const Curve& curve, const Axis& x, const Axis& y, float width,
                const Vec3f& color, float dash) {
  const Curve few = thinned(curve, x.low, x.high, int(x.to - x.from) + 1);
  Polygon line;
  const auto finish = [&] {
    if (line.size() == 1) line.push_back(line[0] + render::Vec2f(0.01f, 0));  // a dot
    if (!line.empty()) painter.stroke(line, width, color, false, dash);
    line.clear();
  };
  for (std::size_t i = 0; i < few.time.size(); ++i) {
    if (is_shown(panel, few.value[i]) && std::isfinite(few.time[i]))
      line.emplace_back(x.place(few.time[i]), y.place(few.value[i]));
    else
      finish();
  }
  finish();
}

// Labels above the panel, in as many rows as they need; returns the number of rows without a painter to draw on.
int draw_legend(Painter& painter, const Panel& panel, const Place& place, const PlotStyle& style, bool draw) {
  if (panel.curves.size() == 1 && panel.curves[0].label.empty()) return 0;
  const float mark = 1.6f * style.size, gap = 0.4f * style.size;
  float x = place.x0;
  int row = 0;
  for (std::size_t n = 0; n < std::min(panel.curves.size(), most_labels + 1); ++n) {
    const bool more = n == most_labels;
    const std::string label = more ? fmt::format("and {} more", panel.curves.size() - n) : panel.curves[n].label;
    const float width = mark + gap + painter.text_width(label, style.size) + 1.2f * style.size;
    if (x > place.x0 && x + width > place.x1) x = place.x0, ++row;
    const float y = place.y0 + (float(row) + 0.8f) * 1.4f * style.size;
    if (draw && !more)
      painter.stroke({{x, y - 0.35f * style.size}, {x + mark, y - 0.35f * style.size}}, 1.6f * style.line(),
                     curve_color(n), false, dash_of(n, style));
    if (draw) painter.text(x + mark + gap, y, label, style.size, style.ink);
    x += width;
  }
  return row + 1;
}

void draw_panel(Painter& painter, const Panel& panel, const Place& place, const PlotStyle& style) {
  const Range time = range_of_time(panel), range = range_of(panel);
  Axis x{time.low, time.high, 0, 0, "time (s)"}, y{range.low, range.high, 0, 0, panel.title, panel.logarithmic};
  const float left = place.x0 + render::room_left(painter, y, place.y1 - place.y0, style) + 0.5f * style.size;
  const float right = place.x1 - 1.2f * style.size;
  const int rows = draw_legend(painter, panel, {left, place.y0, right, place.y1}, style, false);
  const float above = place.y0 + (1.4f * float(rows) + 0.6f) * style.size;
  const float below = place.y1 - render::room_below(x, style) - 0.5f * style.size;
  if (!(right - left > 4 * style.size && below - above > 2 * style.size)) return;
  x.from = left, x.to = right, y.from = below, y.to = above;
  draw_frame(painter, x, y, style, true);
  painter.within({{{left, above}, {right, above}, {right, below}, {left, below}}}, [&] {
    for (std::size_t n = 0; n < panel.curves.size(); ++n)
      draw_curve(painter, panel, panel.curves[n], x, y, 1.6f * style.line(), curve_color(n), dash_of(n, style));
  });
  draw_legend(painter, panel, {left, place.y0, right, place.y1}, style, true);
}

// Number of columns of panels whose shape is nearest to 1.7 : 1.
int columns_for(int panels, float width, float height) {
  int best = 1;
  float least = 1e30f;
  for (int columns = 1; columns <= panels; ++columns) {
    const int rows = (panels + columns - 1) / columns;
    const float shape = (width / float(columns)) / (height / float(rows));
    const float fault = std::abs(std::log(shape / 1.7f)) + 0.15f * float(rows * columns - panels);
    if (fault < least) least = fault, best = columns;
  }
  return best;
}

}  // namespace

Range range_of(const Panel& panel) {
  Range range{1e300, -1e300};
  for (const Curve& curve : panel.curves)
    for (const double value : curve.value)
      if (is_shown(panel, value)) range.low = std::min(range.low, value), range.high = std::max(range.high, value);
  if (range.low > range.high) return panel.logarithmic ? Range{0.1, 1} : Range{0, 1};
  if (panel.logarithmic) {
    const double spare = std::max(1.2, std::pow(range.high / range.low, 0.05));
    return {range.low / spare, range.high * spare};
  }
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  double spare = 0.05 * (range.high - range.low);
  // a constant, or one that rounding alone moves
  if (!(range.high - range.low > 1e-6 * size)) spare = size > 0 ? 0.1 * size : 1;
  return {range.low - spare, range.high + spare};
}

Curve thinned(const Curve& curve, double from, double until, int columns) {
  if (curve.time.size() <= std::size_t(4) * std::size_t(columns)) return curve;
  Curve few{curve.label, {}, {}};
  const auto column = [&](std::size_t i) { return std::floor((curve.time[i] - from) / (until - from) * columns); };
  for (std::size_t i = 0; i < curve.time.size();) {
    std::vector<std::size_t> kept{i};
    std::size_t end = i, low = i, high = i;
    for (; end < curve.time.size() && (end == i || column(end) == column(i)); ++end) {
      const double value = curve.value[end];
      if (!std::isfinite(value)) kept.push_back(end);  // gaps stay
      if (!(value >= curve.value[low])) low = end;
      if (!(value <= curve.value[high])) high = end;
    }
    kept.insert(kept.end(), {low, high, end - 1});
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const std::size_t k : kept) few.time.push_back(curve.time[k]), few.value.push_back(curve.value[k]);
    i = end;
  }
  return few;
}

void draw_sheet(Painter& painter, const std::vector<Panel>& panels) {
  const auto width = float(painter.width()), height = float(painter.height());
  const int count = int(panels.size()), columns = columns_for(count, width, height);
  const int rows = (count + columns - 1) / columns;
  const float room_x = width / float(columns), room_y = height / float(rows);
  PlotStyle style{std::max(9.0f, 0.75f * render::text_size(int(2.2f * room_x), int(2.2f * room_y)))};
  style.size = std::min(style.size, std::max(9.0f, 1.1f * render::text_size(painter.width(), painter.height())));
  for (int n = 0; n < count; ++n) {
    const int column = n % columns, row = n / columns;
    const float x = float(column) * room_x, y = float(row) * room_y;
    draw_panel(painter, panels[std::size_t(n)], {x, y + 0.4f * style.size, x + room_x, y + room_y}, style);
  }
}

}  // namespace seiche::charts
