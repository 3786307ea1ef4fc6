// VTK's XML format for unstructured grids (VTK file formats); one piece only.
#include "base/error.h"
#include "geometry/mesh/vtk_document.h"
#include "solid/mesh/file.h"

namespace seiche::elastic {
namespace {

using mesh::Source;
using mesh::VtkArray;
using mesh::VtkDocument;

const VtkArray& need(const VtkDocument& document, const std::string& section, const std::string& name) {
  if (const VtkArray* array = mesh::find_array(document, section, name)) return *array;
  mesh::fail_in_line_of(document.source, document.piece_byte,
                        "<" + section + "> has no array" + (name.empty() ? "" : " '" + name + "'"));
}

CellKind vtk_cell_kind(long long type) {
  switch (type) {
    case 5:
      return CellKind::triangle;
    case 22:
      return CellKind::quadratic_triangle;
    case 10:
      return CellKind::tetrahedron;
    case 24:
      return CellKind::quadratic_tetrahedron;
    default:
      return CellKind::other;
  }
}

std::vector<Vec3> read_points(const VtkDocument& document) {
  const VtkArray& array = need(document, "Points", "");
  const std::vector<double> xyz = mesh::read_numbers(document, array);
  if (xyz.size() % 3 != 0) {
    mesh::fail_in_line_of(document.source, array.byte, "three numbers a point are wanted");
  }
  if (xyz.size() / 3 > mesh::max_points) mesh::fail_in_line_of(document.source, array.byte, "has too many points");
  std::vector<Vec3> points;
  points.reserve(xyz.size() / 3);
  for (size_t n = 0; n < xyz.size(); n += 3) points.emplace_back(xyz[n], xyz[n + 1], xyz[n + 2]);
  return points;
}

// Adds the cells; the nodes of a cell end at its offset.
void add_cells(const VtkDocument& document, RawMesh& r) {
  const VtkArray& connectivity = need(document, "Cells", "connectivity");
  const auto fail = [&](const std::string& message) {
    mesh::fail_in_line_of(document.source, connectivity.byte, message);
  };
  const auto nodes = mesh::read_integers(document, connectivity);
  const auto offsets = mesh::read_integers(document, need(document, "Cells", "offsets"));
  const auto types = mesh::read_integers(document, need(document, "Cells", "types"));
  if (types.size() != offsets.size()) fail("there are not as many types as offsets");
  long long first = 0;
  for (size_t c = 0; c < types.size(); first = offsets[c++]) {
    const CellKind kind = vtk_cell_kind(types[c]);
    if (offsets[c] < first || offsets[c] > (long long)(nodes.size())) fail("an offset is out of range");
    if (kind == CellKind::other) {
      ++r.others;
      continue;
    }
    if (offsets[c] - first != nodes_of(kind)) fail("cell " + std::to_string(c) + " has not the nodes of its type");
    for (long long n = first; n < offsets[c]; ++n) {
      if (nodes[n] < 0 || nodes[n] >= (long long)(r.points.size())) {
        fail("there is no node " + std::to_string(nodes[n]));
      }
      r.cells[int(kind)].push_back(int(nodes[n]));
    }
  }
}

}  // namespace

RawMesh parse_vtu(const Source& source) {
  const VtkDocument document = mesh::parse_vtk(source);
  RawMesh r;
  r.points = read_points(document);
  add_cells(document, r);
  return r;
}

}  // namespace seiche::elastic
