#pragma once
// Meshing by CGAL; no other file sees its types. Serial and independent of clocks: equal input gives an equal mesh.
#include "solid/mesh/mesh.h"

namespace seiche::cgal {

// Triangles inside a closed outline (even-odd) with edges of at most `size` (m), by constrained Delaunay refinement
// (Ruppert 1995). The outline's points stay; its segments may be split. Throws Error(bad_input) without a location.
ElasticMesh<2> triangulate(const SurfaceMesh& outline, double size);

enum class SharpEdges { rounded, kept };

struct TetrahedraOptions {
  double size = 0;      // edge length, approximate (m)
  double distance = 0;  // largest distance of the mesh's surface from the given one (m)
  SharpEdges edges = SharpEdges::kept;
};

// Tetrahedra inside a closed surface, by Delaunay refinement with sliver perturbation and exudation (Cheng et al.
// 2000). Edges of more than 60 degrees (between normals) are kept on request. Throws Error(bad_input) without a
// location.
ElasticMesh<3> tetrahedralize(const SurfaceMesh& surface, const TetrahedraOptions& options);

}  // namespace seiche::cgal
