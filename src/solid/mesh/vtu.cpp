// VTK's XML format for unstructured grids (VTK file formats); text arrays and one piece only.
#include <algorithm>

#include "base/error.h"
#include "solid/mesh/file.h"

namespace seiche::elastic {
namespace {

using mesh::Source;
using mesh::Tokens;

size_t line_of(const Source& source, size_t byte) {
  return 1 + size_t(std::count(source.bytes.begin(), source.bytes.begin() + long(byte), '\n'));
}

[[noreturn]] void fail_at(const Source& source, size_t byte, const std::string& message) {
  mesh::fail_at_line(source, line_of(source, std::min(byte, source.bytes.size())), message);
}

// Position of `text` between two bytes; fails if it is missing.
size_t find(const Source& source, const std::string& text, size_t from, size_t to) {
  const size_t at = source.bytes.find(text, from);
  if (at == std::string::npos || at >= to) fail_at(source, from, text + " is missing");
  return at;
}

// Numbers of the DataArray with this attribute ("" for any) between two bytes.
Tokens array(const Source& source, size_t from, size_t to, const std::string& attribute) {
  for (size_t tag = find(source, "<DataArray", from, to);; tag = find(source, "<DataArray", tag + 1, to)) {
    const size_t body = find(source, ">", tag, to) + 1;
    const std::string head = source.bytes.substr(tag, body - tag);
    if (head.find(attribute) == std::string::npos) continue;
    if (head.find("format=\"ascii\"") == std::string::npos)
      fail_at(source, tag, "the array is not text; save as ASCII");
    const size_t end = find(source, "</DataArray>", body, to);
    return Tokens(std::string_view(source.bytes).substr(body, end - body), line_of(source, body));
  }
}

CellKind kind_of(long long type) {
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

std::vector<long long> integers(const Source& source, Tokens tokens) {
  std::vector<long long> r;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    const auto value = mesh::to_integer(token);
    if (!value) mesh::fail_at_line(source, tokens.line(), "no integer: " + std::string(token.substr(0, 40)));
    r.push_back(*value);
  }
  return r;
}

// Adds the cells; the nodes of a cell end at its offset.
void add_cells(const Source& source, size_t cells, size_t end, RawMesh& r) {
  const auto nodes = integers(source, array(source, cells, end, "\"connectivity\""));
  const auto offsets = integers(source, array(source, cells, end, "\"offsets\""));
  const auto types = integers(source, array(source, cells, end, "\"types\""));
  if (types.size() != offsets.size()) fail_at(source, cells, "there are not as many types as offsets");
  long long first = 0;
  for (size_t c = 0; c < types.size(); first = offsets[c++]) {
    const CellKind kind = kind_of(types[c]);
    if (offsets[c] < first || offsets[c] > (long long)(nodes.size()))
      fail_at(source, cells, "an offset is out of range");
    if (kind == CellKind::other) {
      ++r.others;
      continue;
    }
    if (offsets[c] - first != nodes_of(kind))
      fail_at(source, cells, "cell " + std::to_string(c) + " has not the nodes of its type");
    for (long long n = first; n < offsets[c]; ++n) {
      if (nodes[n] < 0 || nodes[n] >= (long long)(r.points.size())) {
        fail_at(source, cells, "there is no node " + std::to_string(nodes[n]));
      }
      r.cells[int(kind)].push_back(int(nodes[n]));
    }
  }
}

}  // namespace

RawMesh parse_vtu(const Source& source) {
  RawMesh r;
  const size_t all = source.bytes.size(), piece = find(source, "<Piece", 0, all),
               end = find(source, "</Piece>", piece, all);
  if (source.bytes.find("<Piece", end) != std::string::npos) fail_at(source, end, "has several pieces; save as one");
  const size_t points = find(source, "<Points", piece, end), cells = find(source, "<Cells", piece, end);
  Tokens tokens = array(source, points, find(source, "</Points>", points, end), "");
  for (auto token = tokens.next(); !token.empty();) {
    Vec3 x;
    for (double& c : x) {
      const auto value = mesh::to_double(token);
      if (!value) mesh::fail_at_line(source, tokens.line(), "three numbers a point are wanted");
      c = *value;
      token = tokens.next();
    }
    r.points.push_back(x);
  }
  add_cells(source, cells, find(source, "</Cells>", cells, end), r);
  return r;
}

}  // namespace seiche::elastic
