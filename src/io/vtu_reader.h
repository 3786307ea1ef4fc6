#pragma once
// Reads the solid surfaces of a frame (frames/solids.NNNN.vtu): triangles or line segments with cell data "solid".
#include <filesystem>

#include "io/render_bvh.h"

namespace seiche::render {

// Understands VTK XML unstructured grids with ascii, inline base64, and appended raw or base64 arrays, uncompressed.
// Elements other than triangles and segments are left out; without "solid" all belong to solid 0.
// Throws Error(bad_input) with the path and what is wrong.
SolidMesh read_solids(const std::filesystem::path& file);

}  // namespace seiche::render
