#include "files/vtu_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "geometry/mesh/vtk_document.h"

namespace seiche::render {
namespace {

using mesh::VtkArray;
using mesh::VtkDocument;

constexpr int vtk_line = 3, vtk_triangle = 5;

[[noreturn]] void fail(const VtkDocument& document, const std::string& message) {
  mesh::fail_in_line_of(document.source, document.piece_byte, message);
}

// Numbers of an array; none without it.
std::vector<double> numbers_of(const VtkDocument& document, const char* section, const char* name) {
  const VtkArray* array = mesh::find_array(document, section, name);
  return array ? mesh::read_numbers(document, *array) : std::vector<double>{};
}

std::vector<long long> integers_of(const VtkDocument& document, const char* section, const char* name) {
  const VtkArray* array = mesh::find_array(document, section, name);
  return array ? mesh::read_integers(document, *array) : std::vector<long long>{};
}

// Cells as VTK lists them: the corners of cell i end at ends[i].
struct Cells {
  std::vector<long long> corners, ends, types, solid;
};

Cells read_cells(const VtkDocument& document) {
  Cells cells{integers_of(document, "Cells", "connectivity"), integers_of(document, "Cells", "offsets"),
              integers_of(document, "Cells", "types"), integers_of(document, "CellData", "solid")};
  const std::size_t count = cells.ends.size();
  if (cells.types.size() != count || (!cells.solid.empty() && cells.solid.size() != count)) {
    fail(document, "the arrays of the cells differ in length");
  }
  for (const long long corner : cells.corners) {
    if (corner < 0) fail(document, fmt::format("there is no point {}", corner));
  }
  return cells;
}

SolidMesh assemble(const VtkDocument& document) {
  SolidMesh solids;
  auto& points = solids.mesh.points;
  const auto xyz = numbers_of(document, "Points", "");
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3) points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  const auto [corners, ends, types, solid] = read_cells(document);
  for (const long long corner : corners) {
    if (corner >= (long long)(points.size())) fail(document, fmt::format("there is no point {}", corner));
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int size = types[i] == vtk_triangle ? 3 : types[i] == vtk_line ? 2 : 0;
    if (size == 0) continue;
    if (ends[i] < size || ends[i] > (long long)(corners.size())) {
      fail(document, fmt::format("cell {} has no corners", i));
    }
    const long long* last = corners.data() + ends[i];
    if (size == 3) solids.mesh.triangles.push_back({int(last[-3]), int(last[-2]), int(last[-1])});
    if (size == 2) solids.mesh.segments.push_back({int(last[-2]), int(last[-1])});
    solids.solid.push_back(solid.empty() ? 0 : int(solid[i]));
  }
  return solids;
}

// Texts as text_array() of vtk.cpp writes them: codes of bytes, each text ended by a zero.
std::vector<std::string> read_texts(const VtkDocument& document, const char* name) {
  std::vector<std::string> texts{""};
  for (const long long code : integers_of(document, "FieldData", name)) {
    if (code == 0) {
      texts.emplace_back();
    } else {
      texts.back() += char(code);
    }
  }
  return texts;
}

double length_at(const std::vector<double>& vectors, std::size_t point) {
  if (3 * point + 3 > vectors.size()) return 0;
  return std::hypot(vectors[3 * point], vectors[3 * point + 1], vectors[3 * point + 2]);
}

// Solids by their number, each with its points.
using Solids = std::map<long long, std::pair<SolidSummary, std::set<std::size_t>>>;

Solids count_cells(const VtkDocument& document) {
  const auto [corners, ends, types, solid] = read_cells(document);
  if (solid.size() != ends.size()) fail(document, "the arrays of the cells differ in length");
  Solids found;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const long long start = i > 0 ? ends[i - 1] : 0;
    if (start < 0 || ends[i] < start || ends[i] > (long long)(corners.size())) {
      fail(document, fmt::format("cell {} has no corners", i));
    }
    auto& [summary, points] = found[solid[i]];
    ++summary.cells;
    for (long long c = start; c < ends[i]; ++c) points.insert(std::size_t(corners[std::size_t(c)]));
  }
  return found;
}

GridSummary summarize(const VtkDocument& document) {
  const auto time = numbers_of(document, "FieldData", "TimeValue");
  const auto displacement = numbers_of(document, "PointData", "displacement"),
             velocity = numbers_of(document, "PointData", "velocity"),
             stress = numbers_of(document, "PointData", "von_mises");
  const auto names = read_texts(document, "solid_names");
  GridSummary summary{time.empty() ? 0 : time[0], !stress.empty(), {}};
  for (auto& [number, entry] : count_cells(document)) {
    auto& [solid, points] = entry;
    if (number >= 0 && std::size_t(number) < names.size()) solid.name = names[std::size_t(number)];
    solid.points = points.size();
    for (const std::size_t p : points) {
      solid.largest_displacement = std::max(solid.largest_displacement, length_at(displacement, p));
      solid.largest_speed = std::max(solid.largest_speed, length_at(velocity, p));
      if (p < stress.size()) solid.largest_stress = std::max(solid.largest_stress, stress[p]);
    }
    summary.solids.push_back(solid);
  }
  return summary;
}

// Result of `take` on a file; its errors say what is expected instead.
template <class Take>
auto read(const std::filesystem::path& file, const char* expected, const Take& take) {
  const mesh::Source source{file, mesh::read_bytes(file)};
  try {
    return take(mesh::parse_vtk(source));
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}; expected {} as 'seiche run' writes them", error.what(), expected));
  }
}

}  // namespace

SolidMesh read_solids(const std::filesystem::path& file) {
  return read(file, "surfaces", assemble);
}

GridSummary summarize_grid(const std::filesystem::path& file) {
  return read(file, "solids", summarize);
}

}  // namespace seiche::render
