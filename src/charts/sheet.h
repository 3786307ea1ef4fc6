#pragma once
// Sheets of panels with curves over time.
#include <string>
#include <vector>

#include "render/painter.h"

namespace seiche::charts {

struct Curve {
  std::string label;
  std::vector<double> time, value;  // values that are not finite leave gaps
};

struct Panel {
  std::string title;  // of the value's axis, with the unit
  std::vector<Curve> curves;
  bool logarithmic = false;  // values of 0 and below leave gaps
};

// Panels side by side and below each other, as fits the sheet best. Draws all of them, with axes, grid and legends.
void draw_sheet(render::Painter& painter, const std::vector<Panel>& panels);

// The curve with at most four points for each of `columns` pixels: the first, least, greatest and last one. So no peak
// is lost.
Curve thinned(const Curve& curve, double from, double until, int columns);

// Least and greatest value of a panel's axis: around all its values, with a twentieth to spare.
struct Range {
  double low = 0, high = 1;
};
Range range_of(const Panel& panel);

}  // namespace seiche::charts
