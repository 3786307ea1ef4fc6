#pragma once
// Meshes made by CGAL; no other file sees its types. Serial and without clocks: the same input gives the same mesh.
#include "solid/mesh/mesh.h"

namespace seiche::cgal {

// Triangles inside a closed outline (even-odd), edges at most `size` (m): constrained Delaunay refinement (Ruppert
// 1995). The outline's points stay; its segments may be split. Throws Error(bad_input), without place.
ElasticMesh<2> triangulate(const SurfaceMesh& outline, double size);

enum class SharpEdges { rounded, kept };

struct TetrahedraOptions {
  double size = 0;      // edges, about (m)
  double distance = 0;  // of the mesh's surface from the given one, at most (m)
  SharpEdges edges = SharpEdges::kept;
};

// Tetrahedra inside a closed surface, whose edges of more than 60 degrees may be kept: Delaunay refinement, then
// slivers perturbed and exuded (Cheng et al. 2000). Throws Error(bad_input), without place.
ElasticMesh<3> tetrahedralize(const SurfaceMesh& surface, const TetrahedraOptions& options);

}  // namespace seiche::cgal
