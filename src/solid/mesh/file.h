#pragma once
// Files of meshes: Gmsh (.msh, version 2 and 4, text), VTK (.vtu, text), Medit (.mesh, text, linear).
#include <filesystem>

#include "geometry/mesh/formats.h"
#include "solid/mesh/mesh.h"

namespace seiche {

// Takes the triangles (2D; all z must be 0) or tetrahedra (3D) and notes how many other elements it left out; inverted
// numbering is refused, not mended. The mesh has passed check_mesh(). Throws Error(bad_input) naming file and line.
template <int Dim>
ElasticMesh<Dim> read_elastic_mesh(const std::filesystem::path& file, std::vector<std::string>& notes);

// Whether the file's name ends like one of these formats.
bool holds_elements(const std::filesystem::path& file);

namespace elastic {

enum class CellKind : int { triangle, quadratic_triangle, tetrahedron, quadratic_tetrahedron, other };

// What a file holds; nodes of cells from 0, one cell after the other, in the order of VTK.
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

// A count of things that take at least two bytes each: never more than the file has left.
long long count_token(const mesh::Source& source, mesh::Tokens& tokens, const char* what);
// Whole tokens that must be numbers.
double number_token(const mesh::Source& source, mesh::Tokens& tokens);
long long integer_token(const mesh::Source& source, mesh::Tokens& tokens);

}  // namespace elastic
}  // namespace seiche
