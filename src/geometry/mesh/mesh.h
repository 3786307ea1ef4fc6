#pragma once
// Surface meshes: triangles in 3D, closed polylines of segments in 2D.
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

// Reads a closed triangle mesh (OBJ, PLY, STL; text or binary). Welds equal points, drops degenerate and duplicate
// triangles with a note, and orients the surface outwards. Checks that it is closed and manifold, and that it does not
// cross or touch itself. Throws Error(bad_input) naming the file and the line, or the number and place of the defects.
SurfaceMesh read_closed_mesh(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace seiche
