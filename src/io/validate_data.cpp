// Tables and curves: the parts that measures are made of.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"
#include "io/validate_measures.h"

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

// Lines that are neither empty nor comments, in fields; the first is the header.
std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(text, '\n')) {
    if (!line.empty() && line[0] != '#') rows.push_back(split(line, ','));
  }
  return rows;
}

double number(const std::vector<std::string>& row, std::size_t column) {
  const std::string text = column < row.size() ? row[column] : "";
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

std::size_t column_named(const std::vector<std::vector<std::string>>& rows, const std::string& name) {
  const std::vector<std::string> header = rows.empty() ? std::vector<std::string>() : rows[0];
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end())
    fail(fmt::format("there is no column '{}' (there are: {})", name, fmt::join(header, ", ")));
  return std::size_t(found - header.begin());
}

// Where y passes `level`, by straight lines.
std::vector<double> crossings(const Points& points, double level) {
  std::vector<double> found;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const double before = points[n - 1].second - level, after = points[n].second - level;
    if ((before < 0) == (after < 0)) continue;
    found.push_back(points[n - 1].first + (points[n].first - points[n - 1].first) * before / (before - after));
  }
  return found;
}

}  // namespace

double slope_between(const Points& points, double low, double high) {
  double count = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
  for (const auto& [x, y] : points) {
    if (y < low || y > high) continue;
    ++count, x_sum += x, y_sum += y;
  }
  for (const auto& [x, y] : points) {
    if (y < low || y > high) continue;
    const double dx = x - x_sum / count;
    xx += dx * dx, xy += dx * (y - y_sum / count);
  }
  if (count < 2 || xx == 0) fail(fmt::format("no slope: {} points between {:g} and {:g}", int(count), low, high));
  return xy / xx;
}

double mean_period(const Points& points, double level) {
  const std::vector<double> times = crossings(points, level);
  if (times.size() < 3) fail(fmt::format("no period: the value passes {:g} only {} times", level, times.size()));
  const std::size_t periods = (times.size() - 1) / 2;
  return (times[2 * periods] - times[0]) / double(periods);
}

std::vector<double> csv_column(const std::string& text, const std::string& name) {
  const auto rows = rows_of(text);
  const std::size_t column = column_named(rows, name);
  std::vector<double> values;
  for (std::size_t n = 1; n < rows.size(); ++n) values.push_back(number(rows[n], column));
  return values;
}

Points csv_points(const std::string& text) {
  const auto rows = rows_of(text);
  Points points;
  for (std::size_t n = 1; n < rows.size(); ++n) points.emplace_back(number(rows[n], 0), number(rows[n], 1));
  return points;
}

Points probe_points(const std::string& text, const std::string& probe) {
  const auto rows = rows_of(text);
  const std::size_t time = column_named(rows, "time"), name = column_named(rows, "name"),
                    value = column_named(rows, "value");
  Points points;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (rows[n].size() <= value || rows[n][name] != probe || rows[n][value].empty()) continue;
    points.emplace_back(number(rows[n], time), number(rows[n], value));
  }
  if (points.empty()) fail(fmt::format("probe '{}' has no samples", probe));
  return points;
}

}  // namespace seiche
