#pragma once
// Mesh files: Gmsh (.msh, version 2 and 4, text), VTK (.vtu, uncompressed), Medit (.mesh, text, linear).
#include <filesystem>

#include "geometry/mesh/formats.h"
#include "solid/mesh/mesh.h"

namespace seiche {

// Reads the triangles (2D; all z must be 0) or tetrahedra (3D) and notes how many other elements were skipped. Inverted
// numbering is an error. The mesh has passed check_mesh(). Throws Error(bad_input) naming file and line.
template <int Dim>
ElasticMesh<Dim> read_elastic_mesh(const std::filesystem::path& file, std::vector<std::string>& notes);

// True if the file has the extension of one of these formats.
bool holds_elements(const std::filesystem::path& file);

namespace elastic {

enum class CellKind : int { triangle, quadratic_triangle, tetrahedron, quadratic_tetrahedron, other };

// Contents of a file. Nodes of cells count from 0, one cell after the other, in VTK's order.
struct RawMesh {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> cells{4};  // by kind
  long long others = 0;                    // cells of other kinds
};

constexpr int nodes_of(CellKind kind) {
  constexpr int counts[] = {3, 6, 4, 10, 0};
  return counts[int(kind)];
}

RawMesh parse_msh(const mesh::Source& source);
RawMesh parse_vtu(const mesh::Source& source);
RawMesh parse_medit(const mesh::Source& source);

// Reads a count of items of at least two bytes each; fails if the rest of the file cannot hold them.
long long count_token(const mesh::Source& source, mesh::Tokens& tokens, const char* what);
// Read a whole token that must be a number.
double number_token(const mesh::Source& source, mesh::Tokens& tokens);
long long integer_token(const mesh::Source& source, mesh::Tokens& tokens);

}  // namespace elastic
}  // namespace seiche
