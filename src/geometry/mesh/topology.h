#pragma once
// Makes a closed, consistently oriented surface of triangles as files hold them, or says why it is none.
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// Points that are equal become one and unused ones go; no note: every STL needs it.
void weld(SurfaceMesh& mesh);

// Triangles with a corner twice, and all but one of triangles on the same three points.
void drop_degenerate_and_duplicate(SurfaceMesh& mesh, std::vector<std::string>& notes);

// Every edge must belong to two triangles. Throws Error(bad_input) with the counts and places of the others.
void require_closed(const SurfaceMesh& mesh);

// Turns triangles so that neighbours agree and each piece faces outwards (a cavity within a piece: into the cavity).
// Throws Error(bad_input) if the surface has one side only or encloses no volume.
void orient(SurfaceMesh& mesh, std::vector<std::string>& notes);

// Triangles whose corners are distinct but lie on a line; after the checks, as their neighbours meet along it.
void drop_slivers(SurfaceMesh& mesh, std::vector<std::string>& notes);

}  // namespace seiche::mesh
