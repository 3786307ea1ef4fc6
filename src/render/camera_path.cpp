#include "render/camera_path.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include "base/error.h"

namespace seiche::render {
namespace {

constexpr std::size_t most_rows = 100'000;
constexpr const char* row_form = "time,eye_x,eye_y,eye_z,look_x,look_y,look_z[,degrees]";

[[noreturn]] void refuse_path(const std::filesystem::path& file, std::size_t line, const std::string& why) {
  throw Error(ExitCode::bad_input, fmt::format("--camera-path: {}:{}: {}", file.string(), line, why));
}

// Numbers between commas; NaN for what is none.
std::vector<double> numbers_of_row(const std::string& row) {
  std::vector<double> numbers;
  std::string cell;
  const auto finish = [&] {
    double value = 0;
    const auto [end, failed] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool whole = failed == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
    numbers.push_back(whole ? value : NAN);
    cell.clear();
  };
  for (const char c : row) {
    if (c == ',' || c == ';')
      finish();
    else if (c != ' ' && c != '\t' && c != '\r')
      cell += c;
  }
  finish();
  return numbers;
}

bool all_numbers(const std::vector<double>& row) {
  return std::none_of(row.begin(), row.end(), [](double value) { return std::isnan(value); });
}

void require_view(const std::filesystem::path& file, std::size_t line, const std::vector<double>& row) {
  if ((Vec3(row[1], row[2], row[3]) - Vec3(row[4], row[5], row[6])).norm() == 0)
    refuse_path(file, line, "the eye and the point looked at are the same; give two points");
  if (row.size() == 8 && !(row[7] > 0 && row[7] < 170))
    refuse_path(file, line, "the field of view must be between 0 and 170 degrees");
}

}  // namespace

CameraSpec CameraPath::at(double time) const {
  std::array<float, 7> v;
  for (std::size_t c = 0; c < v.size(); ++c) v[c] = float(columns[c](time));
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]};
}

CameraPath read_camera_path(const std::filesystem::path& file, CurveForm form) {
  std::ifstream in(file);
  if (!in) throw Error(ExitCode::bad_input, fmt::format("--camera-path: {}: cannot be read", file.string()));
  CameraPath path;
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::vector<double> row = numbers_of_row(text);
    if (line == 1 && std::isnan(row[0])) continue;  // a header
    if ((row.size() != 7 && row.size() != 8) || !all_numbers(row))
      refuse_path(file, line, fmt::format("is not a row of numbers {}", row_form));
    require_view(file, line, row);
    std::vector<double>& times = path.columns[0].times;
    if (!times.empty() && !(row[0] > times.back()))
      refuse_path(file, line,
                  fmt::format("its time {:g} does not come after {:g}; sort the rows", row[0], times.back()));
    if (times.size() == most_rows) refuse_path(file, line, fmt::format("at most {} rows", most_rows));
    for (std::size_t c = 0; c < path.columns.size(); ++c) {
      path.columns[c].times.push_back(row[0]);
      path.columns[c].values.push_back(c + 1 < row.size() ? row[c + 1] : double(CameraSpec().degrees));
    }
  }
  if (path.empty()) refuse_path(file, 1, fmt::format("has no rows {}", row_form));
  for (TimeCurve& curve : path.columns) {
    curve.form = form;
    curve.set_slopes();
  }
  return path;
}

}  // namespace seiche::render
