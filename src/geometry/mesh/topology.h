#pragma once
// Turns the triangles of a file into a closed, consistently oriented surface, or reports why this is impossible.
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// Merges equal points and removes unused ones. Leaves no note, since every STL needs it.
void weld(SurfaceMesh& mesh);

// Removes triangles with a repeated corner, and all but one of the triangles on the same three points. Throws
// Error(bad_input) if fewer than 4 are left.
void drop_degenerate_and_duplicate(SurfaceMesh& mesh, std::vector<std::string>& notes);

// Throws Error(bad_input) with number and places of the edges that do not belong to exactly two triangles.
void require_closed(const SurfaceMesh& mesh);

// Reorients triangles so that neighbours agree and each connected piece faces outwards; a cavity within a piece faces
// into the cavity. Throws Error(bad_input) if the surface is one-sided or a piece encloses no volume.
void orient(SurfaceMesh& mesh, std::vector<std::string>& notes);

// Removes triangles with distinct but collinear corners. Must follow the checks, since their neighbours then meet along
// the line.
void drop_slivers(SurfaceMesh& mesh, std::vector<std::string>& notes);

}  // namespace seiche::mesh
