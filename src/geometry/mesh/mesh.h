#pragma once
// Triangle meshes of solids (and in 2D closed polylines, as two-index elements).
#include <array>
#include <filesystem>
#include <vector>

#include "base/vec.h"

namespace seiche {

struct SurfaceMesh {
  std::vector<Vec3> points;                   // m
  std::vector<std::array<int, 3>> triangles;  // 3D; counter-clockwise seen from outside
  std::vector<std::array<int, 2>> segments;   // 2D; the inside lies to the left
};

// Reads a closed triangle mesh (OBJ, PLY, STL; text or binary), welds equal points, drops degenerate and duplicate
// triangles with a note, orients it outwards and checks that it is closed, manifold and nowhere crosses or touches
// itself. Throws Error(bad_input) naming the file and line or count and place of what is wrong.
SurfaceMesh read_closed_mesh(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace seiche
