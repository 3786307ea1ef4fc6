#pragma once
// Reads the solid surfaces of a frame (frames/solids.NNNN.vtu): triangles or line segments with cell data "solid".
#include <filesystem>
#include <string>
#include <vector>

#include "files/solid_mesh.h"

namespace seiche::render {

// Understands VTK XML unstructured grids with ascii, inline base64, and appended raw or base64 arrays, uncompressed.
// Elements other than triangles and segments are left out; without "solid" all belong to solid 0.
// Throws Error(bad_input) with the path and what is wrong.
SolidMesh read_solids(const std::filesystem::path& file);

// What there is of one solid in a grid of cells.
struct SolidSummary {
  std::string name;  // "" where the file does not say
  std::size_t cells = 0, points = 0;
  double largest_displacement = 0, largest_speed = 0, largest_stress = 0;  // m, m/s, Pa; 0 without these fields
};

struct GridSummary {
  double time = 0;
  bool has_fields = false;           // displacement, velocity, von_mises
  std::vector<SolidSummary> solids;  // those with cells
};

// Of frames/solids.NNNN.vtu or frames/elastic.NNNN.vtu. Throws Error(bad_input) with the path and what is wrong.
GridSummary summarize_grid(const std::filesystem::path& file);

}  // namespace seiche::render
