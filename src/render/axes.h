#pragma once
// Ticks and frames of plots.
#include <optional>
#include <string>
#include <vector>

#include "render/painter.h"

namespace seiche::render {

// Round step (1, 2 or 5 times a power of ten) that divides `range` into about `count` parts.
double tick_step(double range, int count);

// The number with the digits that a step of this size needs.
std::string tick_text(double value, double step);

// One axis: its values, their places in pixels, and the numbers on it.
struct Axis {
  double low = 0, high = 1;
  float from = 0, to = 1;  // pixels of low and high
  std::string title;
  bool logarithmic = false;  // then low > 0

  float place(double value) const;
};

struct Tick {
  double value;
  std::string text;
};

// About `count` ticks within the axis, ascending. Logarithmic axes have powers of ten, or round numbers between few of
// them.
std::vector<Tick> ticks_of(const Axis& axis, int count);

// Texts and lines of a plot.
struct PlotStyle {
  float size = 12;  // of texts, pixels
  Vec3f ink{0.05f, 0.06f, 0.08f};
  float line() const { return size / 14; }
  float tick() const { return 0.4f * size; }
};

// Widest text of the ticks, in pixels.
float widest(const Painter& painter, const std::vector<Tick>& ticks, float size);

// A rectangle with ticks, numbers and titles outside of it: x below, y at the left with its title read upwards.
// `grid`: with faint lines at the ticks.
void draw_frame(Painter& painter, const Axis& x, const Axis& y, const PlotStyle& style, bool grid);

// Room that draw_frame() takes at the left of the rectangle and below it, for an axis of about that length in pixels.
float room_left(const Painter& painter, Axis y, float length, const PlotStyle& style);
float room_below(const Axis& x, const PlotStyle& style);

}  // namespace seiche::render
