#pragma once
// The size of a mesh file, for checks before anything is computed from it.
#include <filesystem>

#include "base/vec.h"

namespace seiche {

// Edge lengths of the bounding box of a file's triangles (OBJ, PLY, STL), in the file's coordinates. Throws
// Error(bad_input) if the file cannot be parsed.
Vec3 mesh_extent(const std::filesystem::path& file);

// The same of a file's polylines.
Vec3 polyline_extent(const std::filesystem::path& file);

}  // namespace seiche
