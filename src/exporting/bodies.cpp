#include "exporting/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <utility>

#include "base/error.h"

namespace seiche::exporting {
namespace {

std::vector<std::string> cells_of_row(const std::string& row) {
  std::vector<std::string> cells(1);
  for (const char c : row) {
    if (c == ',')
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

bool read_number(const std::string& text, double& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// Columns of time, name and pose in the header; throws if one is missing.
std::map<std::string, std::size_t> columns_of(const std::filesystem::path& file, const std::string& header) {
  const std::vector<std::string> names = cells_of_row(header);
  std::map<std::string, std::size_t> columns;
  for (const char* name : {"time", "name", "x", "y", "z", "qw", "qx", "qy", "qz"}) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      throw Error(ExitCode::bad_input, fmt::format("{}:1: there is no column '{}'", file.string(), name));
    columns[name] = std::size_t(found - names.begin());
  }
  return columns;
}

}  // namespace

std::vector<SurfaceMesh> split(const render::SolidMesh& solids, std::size_t count) {
  std::vector<SurfaceMesh> parts(count);
  std::vector<std::size_t> owner(solids.mesh.points.size(), count);
  std::vector<int> place(solids.mesh.points.size());
  const auto local = [&](std::size_t part, int point) {
    int& at = place[std::size_t(point)];
    if (std::exchange(owner[std::size_t(point)], part) != part) {
      at = int(parts[part].points.size());
      parts[part].points.push_back(solids.mesh.points[std::size_t(point)]);
    }
    return at;
  };
  for (std::size_t t = 0; t < solids.mesh.triangles.size(); ++t) {
    const auto part = std::size_t(solids.solid[t]);
    if (part >= count) continue;
    std::array<int, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = local(part, solids.mesh.triangles[t][c]);
    parts[part].triangles.push_back(corners);
  }
  return parts;
}

PoseTable::PoseTable(const std::filesystem::path& file, const std::vector<std::string>& solids)
    : file_(file), names_(solids), rows_(solids.size()) {
  if (solids.empty()) return;
  std::ifstream in(file);
  std::string row;
  if (!in || !std::getline(in, row))
    throw Error(ExitCode::bad_input, file.string() + ": cannot be read; it places the solids of a run");
  const auto column = columns_of(file, row);
  for (std::size_t line = 2; std::getline(in, row); ++line) {
    const std::vector<std::string> cells = cells_of_row(row);
    std::array<double, 8> v{};
    bool sound = std::ranges::all_of(column, [&](const auto& c) { return c.second < cells.size(); });
    std::size_t n = 0;
    for (const char* name : {"time", "x", "y", "z", "qw", "qx", "qy", "qz"})
      sound = sound && read_number(cells[column.at(name)], v[n++]);
    if (!sound) throw Error(ExitCode::bad_input, fmt::format("{}:{}: is no row of a solid", file.string(), line));
    const auto solid = std::ranges::find(names_, cells[column.at("name")]) - names_.begin();
    if (solid == std::ptrdiff_t(names_.size())) continue;
    rows_[std::size_t(solid)].push_back({v[0], {{v[1], v[2], v[3]}, Eigen::Quaterniond(v[4], v[5], v[6], v[7])}});
  }
}

const Pose& PoseTable::at(std::size_t solid, double t) const {
  const double same = 1e-9 * std::max(1.0, std::abs(t));  // the table's times have 17 digits
  const auto& rows = rows_.at(solid);
  const auto row = std::ranges::lower_bound(rows, t - same, {}, [](const auto& r) { return r.first; });
  if (row != rows.end() && row->first <= t + same) return row->second;
  throw Error(ExitCode::bad_input, fmt::format("{}: there is no row of '{}' at t = {:g} s, the time of a frame",
                                               file_.string(), names_[solid], t));
}

}  // namespace seiche::exporting
