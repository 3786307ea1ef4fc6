#pragma once
// Measures of the runs of validation cases. A new measure is a row of a table in kinds_*.cpp.
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/run_directory.h"
#include "scene/section.h"
#include "validate/measure/spec.h"

namespace seiche {

struct Measurement {
  double value = 0;                 // in the unit of the measure
  std::optional<double> reference;  // unset: the value itself is the error
  double error = 0;                 // compared with the bar; never negative
};

// The larger of two numbers; NaN if either is NaN, which std::max may lose.
inline double larger(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

// Value of a constant formula.
double constant(const Formula& formula);

// Reads the output in a run's directory. Throws Error(cannot_continue) if it lacks the measured quantity.
Measurement measure(const MeasureSpec& spec, const RunPaths& run);

// Series over time (s) that the measure is computed from; for front_slope in its own units. Empty for measures of
// frames. Throws as measure() does.
std::vector<std::pair<double, double>> measured_series(const MeasureSpec& spec, const RunPaths& run);

// Keys of [measure].
Section<MeasureSpec> measure_section();

// Operations that measures are composed of.

using Points = std::vector<std::pair<double, double>>;

// Least-squares slope of y(x) over the points with low <= y <= high. Throws Error(cannot_continue) for less than two.
double slope_between(const Points& points, double low, double high);

// Mean period of y(x) about `level`: whole periods between the first and the last suitable crossing, by linear
// interpolation. Throws Error(cannot_continue) for less than one period.
double mean_period(const Points& points, double level);

// Standard deviation of the periods over their mean. A period runs from each crossing to the second after it. A
// crossing counts if it lies between points on both sides that are farther from `level` than a quarter of the farthest.
// Throws Error(cannot_continue) for less than two periods, and if the swings end more than a mean period before the
// points.
double period_scatter(const Points& points, double level);

// Fields of CSV lines that are neither empty nor comments ('#'); the first line is the header.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

// Column of CSV text by name. Throws Error(cannot_continue) if it is missing, and for fields that are not finite
// numbers.
std::vector<double> csv_column(const std::string& text, const std::string& name);

// First two columns of CSV text below its header; skips lines that begin with '#'. Throws as csv_column(), and if the
// first row consists of numbers.
Points csv_points(const std::string& text);

// Least-squares slope of y(x) over the points with from <= x <= to. Throws Error(cannot_continue) for less than two,
// and if the points do not cover this interval.
double slope_during(const Points& points, double from, double to);

// Windowed mean of y(x) over from <= x <= to: trapezoidal rule with the weight sin^2, zero at both ends. It removes
// almost all of oscillations with more than two periods. Throws Error(cannot_continue) if the points do not cover the
// interval.
double settled_mean(const Points& points, double from, double to);

// "a + b" -> a, b
std::vector<std::string> parts_of_sum(const std::string& solids);

// time and a column of a solid, or of its sum over "several + solids", from the text of solids.csv.
Points solid_points(const std::string& text, const std::string& solids, const std::string& column);

// Root mean square of y(x) - z(x) over the points of z, with y interpolated linearly. Throws Error(cannot_continue) if
// y does not cover z.
double rms_difference(const Points& y, const Points& z);
// Largest |y(x) - z(x)|, likewise.
double largest_difference(const Points& y, const Points& z);

// Decay rate b, per unit of x, of the squared amplitude exp(-b x) of y(x) about `level`: minus twice the least-squares
// slope of ln|y - level| over the extremes between crossings. Throws Error(cannot_continue) for less than three
// extremes.
double energy_decay(const Points& y, double level);

// Growth rate of |y(x) - level| per unit of x: least-squares slope of its logarithm over from <= x <= to. Throws
// Error(cannot_continue) if y equals the level or the points do not cover the interval.
double growth_rate(const Points& points, double level, double from, double to);

// Point of the largest y over from <= x <= to. Throws as points_during().
Points::value_type highest_during(const Points& points, double from, double to);

// Point of the largest |y| over from <= x <= to. Throws as points_during().
Points::value_type peak_during(const Points& points, double from, double to);

// Smallest and largest y over from <= x <= to. Throws as points_during().
std::pair<double, double> extremes_during(const Points& points, double from, double to);

// Root mean square of y(x) over from <= x <= to by the trapezoidal rule. Throws as points_during(), and for a single
// point.
double root_mean_square(const Points& points, double from, double to);

// Largest distance of any solid from its position in its first row with time >= from, m.
double farthest_stray(const std::string& text, double from);

// time and a column of a probe (vectors have x, y, z) from the text of probes.csv, without undefined samples.
Points probe_points(const std::string& text, const std::string& probe, const std::string& column = "value");

// time and pressure (Pa) of a probe from the text of probes.csv; 0 outside the liquid.
Points impact_points(const std::string& text, const std::string& probe);

// Points with from <= x <= to. Throws Error(cannot_continue) if the points do not cover the interval, and if there are
// none in it.
Points points_during(const Points& points, double from, double to);

}  // namespace seiche
