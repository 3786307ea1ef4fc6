#pragma once
// The size of a mesh, before anything is computed from it.
#include <filesystem>

#include "base/vec.h"

namespace seiche {

// The edges of the box round the triangles of a file (OBJ, PLY, STL), as they stand there. Throws Error(bad_input)
// where the file cannot be parsed.
Vec3 mesh_extent(const std::filesystem::path& file);

}  // namespace seiche
