#include "validate/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

// Whole picture and frame of the axes, in SVG units.
constexpr double width = 640, height = 360, left = 78, right = 626, top = 14, bottom = 312;
constexpr std::size_t most_points = 800;
constexpr std::array<const char*, 6> colors{"#1f5fa8", "#c8451b", "#2c8a4b", "#7a4fa3", "#b0871e", "#4d4d4d"};

// Maps values to the picture along one axis.
struct Scale {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double from = 0, to = 1;  // coordinates in the picture
  bool logarithmic = false;

  double measure(double value) const { return logarithmic ? std::log10(value) : value; }
  bool takes(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  void include(double value) {
    low = std::min(low, measure(value));
    high = std::max(high, measure(value));
  }
  void widen(double share) {
    const double least = logarithmic ? 0.2 : std::max(1e-12, 1e-3 * std::max(std::abs(low), std::abs(high)));
    const double margin = std::max(share * (high - low), high - low < least ? least : 0);
    low -= margin;
    high += margin;
  }
  double at(double value) const { return from + (to - from) * (measure(value) - low) / (high - low); }
  bool shows(double value) const { return measure(value) >= low - 1e-9 && measure(value) <= high + 1e-9; }
};

struct Scales {
  Scale x, y;
  bool any = false;
  bool takes(const std::pair<double, double>& p) const { return x.takes(p.first) && y.takes(p.second); }
};

Scales scales_of(const Chart& chart) {
  Scales s;
  s.x.from = left, s.x.to = right;
  s.y.from = bottom, s.y.to = top;
  s.x.logarithmic = s.y.logarithmic = chart.axes == Chart::Axes::logarithmic;
  for (const Curve& curve : chart.curves)
    for (const auto& p : curve.points) {
      if (!s.takes(p)) continue;
      s.any = true;
      s.x.include(p.first);
      s.y.include(p.second);
    }
  s.x.widen(s.x.logarithmic ? 0.08 : 0);
  s.y.widen(0.06);
  return s;
}

// Powers of ten, with digits between them if there are few.
std::vector<double> logarithmic_steps(double low, double high) {
  std::vector<double> steps;
  const double decades = high - low;
  const std::vector<double> digits = decades > 2.5   ? std::vector<double>{1}
                                     : decades > 0.9 ? std::vector<double>{1, 2, 5}
                                                     : std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 8};
  for (int power = int(std::floor(low)); power <= int(std::ceil(high)); ++power)
    for (const double digit : digits) {
      const double value = digit * std::pow(10.0, power);
      if (std::log10(value) >= low && std::log10(value) <= high) steps.push_back(value);
    }
  return steps;
}

std::vector<double> steps_of(const Scale& s) {
  return s.logarithmic ? logarithmic_steps(s.low, s.high) : round_steps(s.low, s.high, 6);
}

std::string line(double x0, double y0, double x1, double y1, const std::string& color) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='{}'/>\n", x0, y0, x1, y1, color);
}

std::string words(double x, double y, const std::string& anchor, const std::string& text, const std::string& more) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor, more,
                     escape_html(text));
}

std::string axes(const Chart& chart, const Scales& s) {
  std::string svg;
  for (const double v : steps_of(s.x)) {
    svg += line(s.x.at(v), top, s.x.at(v), bottom, "#e4e4e4");
    svg += words(s.x.at(v), bottom + 16, "middle", fmt::format("{:.4g}", v), "");
  }
  for (const double v : steps_of(s.y)) {
    svg += line(left, s.y.at(v), right, s.y.at(v), "#e4e4e4");
    svg += words(left - 6, s.y.at(v) + 4, "end", fmt::format("{:.4g}", v), "");
  }
  svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", left, top,
                     right - left, bottom - top);
  svg += words((left + right) / 2, height - 12, "middle", chart.x, "");
  const double middle = (top + bottom) / 2;
  return svg + words(14, middle, "middle", chart.y, fmt::format("transform='rotate(-90 14 {})'", middle));
}

std::string path_of(const Curve& curve, const Scales& s, const std::string& color) {
  std::string points;
  for (const auto& p : thinned(curve.points, most_points))
    if (s.takes(p)) points += fmt::format("{:.1f},{:.1f} ", s.x.at(p.first), s.y.at(p.second));
  const bool dashed = curve.style == Curve::Style::dashes;
  return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.6'{}/>\n", points, color,
                     dashed ? " stroke-dasharray='5 4'" : "");
}

std::string marks_of(const Curve& curve, const Scales& s, const std::string& color) {
  std::string svg;
  for (const auto& p : curve.points)
    if (s.takes(p) && s.x.shows(p.first) && s.y.shows(p.second))
      svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.2' fill='none' stroke='{}' stroke-width='1.4'/>\n",
                         s.x.at(p.first), s.y.at(p.second), color);
  return svg;
}

std::string legend(const Chart& chart) {
  std::string svg;
  double y = top + 16;
  for (std::size_t n = 0; n < chart.curves.size(); ++n, y += 16) {
    const std::string fill = fmt::format("fill='{}' font-weight='600'", colors[n % colors.size()]);
    svg += words(right - 8, y, "end", chart.curves[n].label, fill);
  }
  return svg;
}

}  // namespace

std::vector<double> round_steps(double low, double high, int count) {
  const double raw = (high - low) / count, power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= raw * (1 - 1e-9)) step = digit * power;
  std::vector<double> steps;
  for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n)
    steps.push_back(n == 0 ? 0 : n * step);
  return steps;
}

// Keeps the lowest and the highest of each group of neighbours.
Points thinned(const Points& points, std::size_t most) {
  if (points.size() <= most) return points;
  const std::size_t group = 2 * points.size() / most + 1;
  const auto below = [](const auto& a, const auto& b) { return a.second < b.second; };
  Points kept;
  for (std::size_t n = 0; n < points.size(); n += group) {
    const auto first = points.begin() + std::ptrdiff_t(n);
    const auto last = points.begin() + std::ptrdiff_t(std::min(n + group, points.size()));
    const auto [least, highest] = std::minmax_element(first, last, below);
    kept.push_back(*std::min(least, highest));
    kept.push_back(*std::max(least, highest));
  }
  return kept;
}

std::string escape_html(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string format_svg(const Chart& chart) {
  const Scales s = scales_of(chart);
  if (!s.any) return {};
  std::string svg = fmt::format("<svg viewBox='0 0 {} {}' role='img'>\n{}", width, height, axes(chart, s));
  for (std::size_t n = 0; n < chart.curves.size(); ++n) {
    const Curve& curve = chart.curves[n];
    const std::string color = colors[n % colors.size()];
    if (curve.style != Curve::Style::marks) svg += path_of(curve, s, color);
    if (curve.style == Curve::Style::marks || curve.style == Curve::Style::line_and_marks)
      svg += marks_of(curve, s, color);
  }
  return svg + legend(chart) + "</svg>\n";
}

}  // namespace seiche
