// Medit's text format (Frey 2001): a keyword, a count, then entries that end in a reference number. Linear elements
// only.
#include "solid/mesh/file.h"

namespace seiche::elastic {
namespace {

using mesh::Source;
using mesh::Tokens;

void read_vertices(const Source& source, Tokens& tokens, long long dimension, RawMesh& r) {
  const long long count = count_token(source, tokens, "vertices");
  for (long long n = 0; n < count; ++n) {
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < dimension; ++a) x[a] = number_token(source, tokens);
    number_token(source, tokens);
    r.points.push_back(x);
  }
}

void read_cells(const Source& source, Tokens& tokens, CellKind kind, RawMesh& r) {
  const long long count = count_token(source, tokens, "elements");
  for (long long n = 0; n < count * nodes_of(kind); ++n) {
    const long long node = integer_token(source, tokens);
    if (node < 1 || node > (long long)(r.points.size())) {
      mesh::fail_at_line(source, tokens.line(), "there is no vertex " + std::to_string(node));
    }
    r.cells[int(kind)].push_back(int(node - 1));
    if (n % nodes_of(kind) == nodes_of(kind) - 1) number_token(source, tokens);
  }
}

}  // namespace

RawMesh parse_medit(const Source& source) {
  Tokens tokens(source.bytes);
  RawMesh r;
  long long dimension = 0;
  bool ended = false;
  for (auto token = tokens.next(); !token.empty() && !ended; token = tokens.next()) {
    if (token[0] == '#') tokens.rest_of_line();
    if (token == "Dimension") dimension = integer_token(source, tokens);
    if (token == "Vertices") {
      if (dimension < 2 || dimension > 3) mesh::fail_at_line(source, tokens.line(), "Dimension must be 2 or 3");
      read_vertices(source, tokens, dimension, r);
    }
    if (token == "Triangles") read_cells(source, tokens, CellKind::triangle, r);
    if (token == "Tetrahedra") read_cells(source, tokens, CellKind::tetrahedron, r);
    if (token == "TrianglesP2" || token == "TetrahedraP2") {
      mesh::fail_at_line(source, tokens.line(), "quadratic elements are not read from Medit files; use .msh or .vtu");
    }
    ended = token == "End";
  }
  if (!ended) mesh::fail_at_line(source, tokens.line(), "the keyword End is missing");
  return r;
}

}  // namespace seiche::elastic
