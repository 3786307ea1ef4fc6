#pragma once
// What can be measured on the run of a validation case. A further measure is a row of a table in kinds_*.cpp.
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
  double value = 0;                 // in the measure's own unit
  std::optional<double> reference;  // unset: the value itself is the error
  double error = 0;                 // what the bar is about, never negative
};

// The larger of two; not a number where one of them is none, which std::max may drop.
inline double larger(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

// The value of a formula that is a constant.
double constant(const Formula& formula);

// Reads what the run left in its directory. Throws Error(cannot_continue) when that does not hold what is measured.
Measurement measure(const MeasureSpec& spec, const RunPaths& run);

// What a measure's figure is taken from, over time (s); of front_slope in its units. Empty for measures of frames.
// Throws Error as measure() does.
std::vector<std::pair<double, double>> measured_series(const MeasureSpec& spec, const RunPaths& run);

// The keys of [measure].
Section<MeasureSpec> measure_section();

// The parts that measures are made of.

using Points = std::vector<std::pair<double, double>>;

// Least-squares slope of y(x) over the points with low <= y <= high. Throws Error(cannot_continue) for under two.
double slope_between(const Points& points, double low, double high);

// Mean period of y(x) about `level`: whole periods between the first crossing and the last that closes one, by
// straight lines between points. Throws Error(cannot_continue) for less than one period.
double mean_period(const Points& points, double level);

// Standard deviation of the whole periods, from each crossing to the second after it, over their mean. To count, a
// crossing must lie between points farther from `level`, to either side, than a quarter of the farthest. Throws
// Error(cannot_continue) for less than two periods, and where the swings end more than a mean period before the points.
double period_scatter(const Points& points, double level);

// The lines of CSV text that are neither empty nor comments ('#'), in fields; the first is the header.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

// A column of CSV text by its header's name. Throws Error(cannot_continue) without it and for fields that are no finite
// numbers.
std::vector<double> csv_column(const std::string& text, const std::string& name);

// The first two columns of CSV text, below its header; lines that begin with '#' are skipped. Throws as csv_column(),
// and for a first row of numbers.
Points csv_points(const std::string& text);

// Least-squares slope of y(x) over the points with from <= x <= to. Throws Error(cannot_continue) for under two, and
// where they do not reach that far.
double slope_during(const Points& points, double from, double to);

// Mean of y(x) over from <= x <= to by trapezoids, weighted with sin^2, zero at both ends: next to nothing is left of
// oscillations that go round more than twice. Throws Error(cannot_continue) where the points do not reach that far.
double settled_mean(const Points& points, double from, double to);

// "a + b" -> a, b
std::vector<std::string> parts_of_sum(const std::string& solids);

// time and a column of a solid, or its sum over "several + solids", from the text of solids.csv.
Points solid_points(const std::string& text, const std::string& solids, const std::string& column);

// Root of the mean square of y(x) - z(x) over the points of z, y by straight lines. Throws Error(cannot_continue) where
// y does not reach as far as z.
double rms_difference(const Points& y, const Points& z);
// Their largest magnitude, likewise.
double largest_difference(const Points& y, const Points& z);

// Rate b, per unit of x, at which the square of a swing of y(x) about `level` dies away, exp(-b x): twice the
// least-squares slope of ln|y - level| over the extremes between crossings, sign turned. Throws Error(cannot_continue)
// for under three extremes.
double energy_decay(const Points& y, double level);

// Rate per unit of x at which |y(x) - level| grows: the least-squares slope of its logarithm over from <= x <= to.
// Throws Error(cannot_continue) where y is at the level or the points do not reach that far.
double growth_rate(const Points& points, double level, double from, double to);

// The point of the largest y over from <= x <= to. Throws as points_during().
Points::value_type highest_during(const Points& points, double from, double to);

// The point of the largest |y| over from <= x <= to. Throws as points_during().
Points::value_type peak_during(const Points& points, double from, double to);

// The smallest and the largest y over from <= x <= to. Throws as points_during().
std::pair<double, double> extremes_during(const Points& points, double from, double to);

// Root of the mean square of y(x) over from <= x <= to, weighted with the way between the points by trapezoids. Throws
// as points_during(), and for a single point.
double root_mean_square(const Points& points, double from, double to);

// The farthest that any solid goes from where it is in its first row with time >= from, m.
double farthest_stray(const std::string& text, double from);

// time and a column of a probe (vectors have x, y, z), from the text of probes.csv, without undefined samples.
Points probe_points(const std::string& text, const std::string& probe, const std::string& column = "value");

// time and pressure of a probe, Pa, 0 where it is not in the liquid, from the text of probes.csv.
Points impact_points(const std::string& text, const std::string& probe);

// The points with from <= x <= to. Throws Error(cannot_continue) where they do not reach that far and where there are
// none between.
Points points_during(const Points& points, double from, double to);

}  // namespace seiche
