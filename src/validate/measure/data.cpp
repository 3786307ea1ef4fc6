// Tables and curves: operations that measures are composed of.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "validate/measure/measures.h"

namespace seiche {
namespace {

[[noreturn]] void fail(const std::string& text) {
  throw Error(ExitCode::cannot_continue, text);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    if (parts.back().ends_with('\r')) parts.back().pop_back();
    at = end + 1;
  }
  return parts;
}

}  // namespace

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(text, '\n')) {
    if (!line.empty() && line[0] != '#') rows.push_back(split(line, ','));
  }
  return rows;
}

namespace {

// The whole field as a number; NaN if it is none, or more than one.
double number(const std::vector<std::string>& row, std::size_t column) {
  const std::string text = column < row.size() ? row[column] : "";
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool whole = std::string_view(end).find_first_not_of(" \t") == std::string_view::npos;
  return end == text.c_str() || !whole ? std::numeric_limits<double>::quiet_NaN() : value;
}

// Throws for numbers that are not finite: runs and references contain none, so the table must be damaged.
double finite_number(const std::vector<std::string>& row, std::size_t column) {
  const double value = number(row, column);
  if (!std::isfinite(value))
    fail(fmt::format("'{}' is not a finite number, in the row {}", column < row.size() ? row[column] : "",
                     fmt::join(row, ",")));
  return value;
}

std::size_t column_named(const std::vector<std::vector<std::string>>& rows, const std::string& name) {
  const std::vector<std::string> header = rows.empty() ? std::vector<std::string>() : rows[0];
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end())
    fail(fmt::format("there is no column '{}' (there are: {})", name, fmt::join(header, ", ")));
  return std::size_t(found - header.begin());
}

// time and a column of the rows with this name. Empty fields are skipped, or count as `empty`.
Points named_points(const std::vector<std::vector<std::string>>& rows, const std::string& wanted,
                    const std::string& column, std::optional<double> empty = {}) {
  const std::size_t time = column_named(rows, "time"), name = column_named(rows, "name"),
                    value = column_named(rows, column);
  Points points;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (rows[n].size() <= value || rows[n][name] != wanted || (rows[n][value].empty() && !empty)) continue;
    points.emplace_back(finite_number(rows[n], time), rows[n][value].empty() ? *empty : finite_number(rows[n], value));
  }
  return points;
}

// Positions at which y passes `level`, by linear interpolation.
std::vector<double> crossings(const Points& points, double level) {
  std::vector<double> found;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const double before = points[n - 1].second - level, after = points[n].second - level;
    if ((before < 0) == (after < 0)) continue;
    found.push_back(points[n - 1].first + (points[n].first - points[n - 1].first) * before / (before - after));
  }
  return found;
}

// Swings go from beyond a band of a quarter of the largest |y - level| to beyond it on the other side. Returns the last
// crossing of each swing.
std::vector<double> swings(const Points& points, double level) {
  double band = 0;
  for (const auto& [x, y] : points) band = larger(band, 0.25 * std::abs(y - level));
  std::vector<double> found;
  Points way;  // points since the last one outside the band
  for (const auto& point : points) {
    way.push_back(point);
    if (std::abs(point.second - level) <= band) continue;
    const std::vector<double> times = crossings(way, level);
    if (times.size() % 2 == 1 && std::abs(way.front().second - level) > band) found.push_back(times.back());
    way = {point};
  }
  return found;
}

Points points_where(const Points& points, const std::function<bool(double, double)>& wanted) {
  Points chosen;
  for (const auto& [x, y] : points)
    if (wanted(x, y)) chosen.emplace_back(x, y);
  return chosen;
}

// Least-squares slope; the bounds are for the message.
double slope(const Points& points, double low, double high) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  for (const auto& [x, y] : points) x_mean += x / double(points.size()), y_mean += y / double(points.size());
  for (const auto& [x, y] : points) xx += (x - x_mean) * (x - x_mean), xy += (x - x_mean) * (y - y_mean);
  if (points.size() < 2 || xx == 0)
    fail(fmt::format("no slope: {} points between {:g} and {:g}", points.size(), low, high));
  return xy / xx;
}

}  // namespace

double slope_between(const Points& points, double low, double high) {
  return slope(points_where(points, [&](double, double y) { return y >= low && y <= high; }), low, high);
}

double slope_during(const Points& points, double from, double to) {
  return slope(points_during(points, from, to), from, to);
}

double settled_mean(const Points& points, double from, double to) {
  const double slack = 1e-9 * (to - from);
  // The first sample may have no value (pressure at t = 0), where the weight is almost zero.
  const double sample = points.size() > 1 ? points[1].first - points[0].first : 0;
  if (points.empty() || points.front().first > from + sample + slack || points.back().first < to - slack)
    fail(fmt::format("no mean: the run does not reach from {:g} s to {:g} s", from, to));
  const auto weight = [&](double t) {
    return std::pow(std::sin(std::numbers::pi * (std::clamp(t, from, to) - from) / (to - from)), 2);
  };
  double sum = 0, weights = 0;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const auto [t0, y0] = points[n - 1];
    const auto [t1, y1] = points[n];
    sum += 0.5 * (t1 - t0) * (weight(t0) * y0 + weight(t1) * y1);
    weights += 0.5 * (t1 - t0) * (weight(t0) + weight(t1));
  }
  if (weights == 0) fail(fmt::format("no mean: no rows between {:g} s and {:g} s", from, to));
  return sum / weights;
}

double mean_period(const Points& points, double level) {
  const std::vector<double> times = crossings(points, level);
  if (times.size() < 3) fail(fmt::format("no period: the value passes {:g} only {} times", level, times.size()));
  const std::size_t periods = (times.size() - 1) / 2;
  return (times[2 * periods] - times[0]) / double(periods);
}

double period_scatter(const Points& points, double level) {
  const std::vector<double> times = swings(points, level);
  if (times.size() < 5) fail(fmt::format("no scatter of periods: {} swings through {:g}", times.size(), level));
  const double count = double(times.size() - 2);
  double mean = 0, variance = 0;
  for (std::size_t n = 2; n < times.size(); ++n) mean += (times[n] - times[n - 2]) / count;
  for (std::size_t n = 2; n < times.size(); ++n) variance += std::pow(times[n] - times[n - 2] - mean, 2) / count;
  if (points.back().first - times.back() > mean)
    fail(fmt::format("the swings end at {:g} s, a period before {:g} s", times.back(), points.back().first));
  return std::sqrt(variance) / mean;
}

namespace {

// Differences y - z at the points of z.
std::vector<double> differences(const Points& y, const Points& z) {
  if (y.empty() || z.empty()) fail("no samples to compare");
  const double slack = 1e-9 * (z.back().first - z.front().first);
  if (z.front().first < y.front().first - slack || z.back().first > y.back().first + slack)
    fail(fmt::format("samples from {:g} to {:g} do not reach the data's {:g} to {:g}", y.front().first, y.back().first,
                     z.front().first, z.back().first));
  std::vector<double> d;
  for (const auto& [x, value] : z) {
    const auto above = std::lower_bound(y.begin() + 1, y.end() - 1, Points::value_type{x, -1e300});
    const auto [x0, y0] = *(above - 1);
    const auto [x1, y1] = *above;
    d.push_back(y0 + (y1 - y0) * (x - x0) / (x1 - x0) - value);
  }
  return d;
}

}  // namespace

double rms_difference(const Points& y, const Points& z) {
  double sum = 0;
  for (const double d : differences(y, z)) sum += d * d;
  return std::sqrt(sum / double(z.size()));
}

double largest_difference(const Points& y, const Points& z) {
  double largest = 0;
  for (const double d : differences(y, z)) largest = larger(largest, std::abs(d));
  return largest;
}

double energy_decay(const Points& y, double level) {
  Points extremes;  // x and ln|y - level|, one between successive crossings
  std::optional<std::pair<double, double>> best;
  bool crossed = false;
  for (std::size_t n = 1; n < y.size(); ++n) {
    const double before = y[n - 1].second - level, now = y[n].second - level;
    if ((before < 0) != (now < 0)) {
      if (crossed && best) extremes.emplace_back(best->first, std::log(best->second));
      crossed = true;
      best.reset();
    }
    if (!best || std::abs(now) > best->second) best = {y[n].first, std::abs(now)};
  }
  if (extremes.size() < 3) fail(fmt::format("no decay: only {} swings about {:g}", extremes.size(), level));
  return -2 * slope(extremes, extremes.front().first, extremes.back().first);
}

double growth_rate(const Points& points, double level, double from, double to) {
  Points logarithms;
  for (const auto& [x, y] : points_during(points, from, to)) {
    if (y == level) fail(fmt::format("no growth: the value is the level, {:g}", level));
    logarithms.emplace_back(x, std::log(std::abs(y - level)));
  }
  return slope(logarithms, from, to);
}

std::vector<double> csv_column(const std::string& text, const std::string& name) {
  const auto rows = csv_rows(text);
  const std::size_t column = column_named(rows, name);
  std::vector<double> values;
  for (std::size_t n = 1; n < rows.size(); ++n) values.push_back(finite_number(rows[n], column));
  return values;
}

Points csv_points(const std::string& text) {
  const auto rows = csv_rows(text);
  if (!rows.empty() && std::isfinite(number(rows[0], 0)))
    fail(fmt::format("the first row is to name the columns: {}", fmt::join(rows[0], ",")));
  Points points;
  for (std::size_t n = 1; n < rows.size(); ++n)
    points.emplace_back(finite_number(rows[n], 0), finite_number(rows[n], 1));
  return points;
}

Points probe_points(const std::string& text, const std::string& probe, const std::string& column) {
  const Points points = named_points(csv_rows(text), probe, column);
  if (points.empty()) fail(fmt::format("probe '{}' has no samples", probe));
  return points;
}

Points impact_points(const std::string& text, const std::string& probe) {
  probe_points(text, probe);  // throws if the probe is never wet
  return named_points(csv_rows(text), probe, "value", 0.0);
}

Points points_during(const Points& points, double from, double to) {
  // Times are sums of steps: rounding must not exclude the last one.
  const double slack = 1e-9 * (to - from);
  if (points.empty() || points.front().first > from + slack || points.back().first < to - slack)
    fail(fmt::format("the run does not reach from {:g} s to {:g} s", from, to));
  const Points chosen = points_where(points, [&](double x, double) { return x >= from - slack && x <= to + slack; });
  if (chosen.empty()) fail(fmt::format("no rows between {:g} s and {:g} s", from, to));
  return chosen;
}

Points::value_type highest_during(const Points& points, double from, double to) {
  const Points chosen = points_during(points, from, to);
  return *std::max_element(chosen.begin(), chosen.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
}

Points::value_type peak_during(const Points& points, double from, double to) {
  const Points chosen = points_during(points, from, to);
  return *std::max_element(chosen.begin(), chosen.end(),
                           [](const auto& a, const auto& b) { return std::abs(a.second) < std::abs(b.second); });
}

std::pair<double, double> extremes_during(const Points& points, double from, double to) {
  const Points chosen = points_during(points, from, to);
  std::pair<double, double> found{chosen[0].second, chosen[0].second};
  for (const auto& [x, y] : chosen) found = {std::min(found.first, y), std::max(found.second, y)};
  return found;
}

double root_mean_square(const Points& points, double from, double to) {
  const Points chosen = points_during(points, from, to);
  double sum = 0;
  for (std::size_t n = 1; n < chosen.size(); ++n) {
    const auto [x0, y0] = chosen[n - 1];
    const auto [x1, y1] = chosen[n];
    sum += 0.5 * (x1 - x0) * (y0 * y0 + y1 * y1);
  }
  const double length = chosen.back().first - chosen.front().first;
  if (length <= 0) fail(fmt::format("no mean: a single row between {:g} s and {:g} s", from, to));
  return std::sqrt(sum / length);
}

namespace {

Points points_of_solid(const std::vector<std::vector<std::string>>& rows, const std::string& solid,
                       const std::string& column) {
  const Points points = named_points(rows, solid, column);
  if (points.empty()) fail(fmt::format("solids.csv has no rows of '{}'", solid));
  return points;
}

}  // namespace

std::vector<std::string> parts_of_sum(const std::string& solids) {
  constexpr std::string_view plus = " + ";
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= solids.size();) {
    const std::size_t end = std::min(solids.find(plus, at), solids.size());
    parts.push_back(solids.substr(at, end - at));
    at = end + plus.size();
  }
  return parts;
}

Points solid_points(const std::string& text, const std::string& solids, const std::string& column) {
  const auto rows = csv_rows(text);
  Points sum;
  for (const std::string& solid : parts_of_sum(solids)) {
    const Points more = points_of_solid(rows, solid, column);
    if (sum.empty()) {
      sum = more;
      continue;
    }
    if (more.size() != sum.size()) fail(fmt::format("solids.csv has not as many rows of each of '{}'", solids));
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n].second += more[n].second;
  }
  return sum;
}

double farthest_stray(const std::string& text, double from) {
  const auto rows = csv_rows(text);
  const std::size_t time = column_named(rows, "time"), name = column_named(rows, "name");
  const std::array columns{column_named(rows, "x"), column_named(rows, "y"), column_named(rows, "z")};
  std::map<std::string, Vec3> start;
  double farthest = 0;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (finite_number(rows[n], time) < from) continue;
    const Vec3 x(finite_number(rows[n], columns[0]), finite_number(rows[n], columns[1]),
                 finite_number(rows[n], columns[2]));
    farthest = larger(farthest, (x - start.try_emplace(rows[n][name], x).first->second).norm());
  }
  if (start.empty()) fail(fmt::format("solids.csv has no rows from {:g} s on", from));
  return farthest;
}

}  // namespace seiche
