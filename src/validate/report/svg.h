#pragma once
// Plots as inline SVG.
#include <string>
#include <vector>

#include "validate/measure/measures.h"

namespace seiche {

struct Curve {
  enum class Style { line, marks, line_and_marks, dashes };
  std::string label;
  Points points;
  Style style = Style::line;
};

struct Chart {
  enum class Axes { linear, logarithmic };
  std::string x, y;  // names of the axes
  Axes axes = Axes::linear;
  std::vector<Curve> curves;
};

// Empty if there is nothing to show: no finite point, or for logarithmic axes no positive one.
std::string format_svg(const Chart& chart);

// Escapes characters with a meaning in HTML and SVG.
std::string escape_html(const std::string& text);

// Round numbers from low to high, about `count` of them.
std::vector<double> round_steps(double low, double high, int count);

// Reduces to about `most` points with the same extremes.
Points thinned(const Points& points, std::size_t most);

}  // namespace seiche
