#pragma once
// Reads the solid surfaces of a frame (frames/solids.NNNN.vtu): triangles or line segments with cell data "solid".
#include <filesystem>
#include <string>
#include <vector>

#include "files/solid_mesh.h"

namespace seiche::render {

// Supports VTK XML unstructured grids with ascii, inline base64 and appended raw or base64 arrays, uncompressed.
// Elements other than triangles and segments are skipped. Without the array "solid" all belong to solid 0. Throws
// Error(bad_input) naming the path and the fault.
SolidMesh read_solids(const std::filesystem::path& file);

// Contents of one solid in a grid of cells.
struct SolidSummary {
  std::string name;  // "" if the file has no names
  std::size_t cells = 0, points = 0;
  double largest_displacement = 0, largest_speed = 0, largest_stress = 0;  // m, m/s, Pa; 0 without these fields
};

struct GridSummary {
  double time = 0;
  bool has_fields = false;           // displacement, velocity, von_mises
  std::vector<SolidSummary> solids;  // those with cells
};

// For frames/solids.NNNN.vtu and frames/elastic.NNNN.vtu. Throws Error(bad_input) naming the path and the fault.
GridSummary summarize_grid(const std::filesystem::path& file);

}  // namespace seiche::render
