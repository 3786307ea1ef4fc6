// Gmsh's text format, versions 2 and 4.1 (Gmsh reference manual, "File formats").
#include <unordered_map>
#include <utility>

#include "solid/mesh/file.h"

namespace seiche::elastic {
namespace {

using mesh::Source;
using mesh::Tokens;

struct Reading {
  const Source& source;
  RawMesh mesh;
  std::unordered_map<long long, int> place;  // of a node's tag
};

CellKind gmsh_cell_kind(long long type) {
  switch (type) {
    case 2:
      return CellKind::triangle;
    case 9:
      return CellKind::quadratic_triangle;
    case 4:
      return CellKind::tetrahedron;
    case 11:
      return CellKind::quadratic_tetrahedron;
    default:
      return CellKind::other;
  }
}

void add_tag(Reading& r, const Tokens& tokens, long long tag, size_t place) {
  if (!r.place.emplace(tag, int(place)).second) {
    mesh::fail_at_line(r.source, tokens.line(), "a second node " + std::to_string(tag));
  }
}

void read_point(Reading& r, Tokens& tokens) {
  Vec3 x;
  for (double& c : x) c = number_token(r.source, tokens);
  r.mesh.points.push_back(x);
}

// The nodes of one element; Gmsh swaps the last two of a quadratic tetrahedron.
void read_cell(Reading& r, Tokens& tokens, CellKind kind) {
  if (kind == CellKind::other) {
    ++r.mesh.others;
    tokens.rest_of_line();
    return;
  }
  auto& cells = r.mesh.cells[int(kind)];
  for (int a = 0; a < nodes_of(kind); ++a) {
    const long long tag = integer_token(r.source, tokens);
    const auto found = r.place.find(tag);
    if (found == r.place.end()) mesh::fail_at_line(r.source, tokens.line(), "there is no node " + std::to_string(tag));
    cells.push_back(found->second);
  }
  if (kind == CellKind::quadratic_tetrahedron) std::swap(cells[cells.size() - 1], cells[cells.size() - 2]);
}

// count, then: tag x y z
void read_nodes_2(Reading& r, Tokens& tokens) {
  const long long count = count_token(r.source, tokens, "nodes");
  for (long long n = 0; n < count; ++n) {
    add_tag(r, tokens, integer_token(r.source, tokens), r.mesh.points.size());
    read_point(r, tokens);
  }
}

// count, then: tag type tags... nodes...
void read_elements_2(Reading& r, Tokens& tokens) {
  const long long count = count_token(r.source, tokens, "elements");
  for (long long e = 0; e < count; ++e) {
    integer_token(r.source, tokens);
    const CellKind kind = gmsh_cell_kind(integer_token(r.source, tokens));
    const long long tags = count_token(r.source, tokens, "tags");
    for (long long i = 0; i < tags; ++i) integer_token(r.source, tokens);
    read_cell(r, tokens, kind);
  }
}

// blocks, count, least and greatest tag; a block: dimension, entity, parametric, count; its tags; its points
void read_nodes_4(Reading& r, Tokens& tokens) {
  const long long blocks = count_token(r.source, tokens, "blocks");
  for (int i = 0; i < 3; ++i) integer_token(r.source, tokens);
  for (long long b = 0; b < blocks; ++b) {
    integer_token(r.source, tokens);
    integer_token(r.source, tokens);
    if (integer_token(r.source, tokens) != 0) {
      mesh::fail_at_line(r.source, tokens.line(), "parametric nodes are not read; save without them");
    }
    const long long count = count_token(r.source, tokens, "nodes");
    const size_t first = r.mesh.points.size();
    for (long long n = 0; n < count; ++n) add_tag(r, tokens, integer_token(r.source, tokens), first + n);
    for (long long n = 0; n < count; ++n) read_point(r, tokens);
  }
}

// blocks, count, least and greatest tag; a block: dimension, entity, type, count; then tag and nodes
void read_elements_4(Reading& r, Tokens& tokens) {
  const long long blocks = count_token(r.source, tokens, "blocks");
  for (int i = 0; i < 3; ++i) integer_token(r.source, tokens);
  for (long long b = 0; b < blocks; ++b) {
    integer_token(r.source, tokens);
    integer_token(r.source, tokens);
    const CellKind kind = gmsh_cell_kind(integer_token(r.source, tokens));
    const long long count = count_token(r.source, tokens, "elements");
    for (long long e = 0; e < count; ++e) {
      integer_token(r.source, tokens);
      read_cell(r, tokens, kind);
    }
  }
}

// The major version, 2 or 4; text only.
int read_format(const Source& source, Tokens& tokens) {
  if (tokens.next() != "$MeshFormat") mesh::fail_at_line(source, tokens.line(), "does not begin with $MeshFormat");
  const double version = number_token(source, tokens);
  if (integer_token(source, tokens) != 0) {
    mesh::fail_at_line(source, tokens.line(), "is binary; save as text (Gmsh: Mesh.Binary = 0)");
  }
  if (version >= 2 && version < 3) return 2;
  if (version >= 4.1 && version < 5) return 4;
  mesh::fail_at_line(source, tokens.line(), "is of a version that is not read; save as version 2.2 or 4.1");
}

}  // namespace

RawMesh parse_msh(const Source& source) {
  Tokens tokens(source.bytes);
  const int version = read_format(source, tokens);
  Reading r{source, {}, {}};
  int sections = 0;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    const bool nodes = token == "$Nodes", elements = token == "$Elements";
    if (nodes) (version == 2 ? read_nodes_2 : read_nodes_4)(r, tokens);
    if (elements) (version == 2 ? read_elements_2 : read_elements_4)(r, tokens);
    if (!nodes && !elements) continue;
    ++sections;
    if (tokens.next() != (nodes ? "$EndNodes" : "$EndElements")) {
      mesh::fail_at_line(source, tokens.line(), nodes ? "$EndNodes is missing" : "$EndElements is missing");
    }
  }
  if (sections < 2) mesh::fail_at_line(source, tokens.line(), "ends without $Nodes and $Elements");
  return r.mesh;
}

}  // namespace seiche::elastic
