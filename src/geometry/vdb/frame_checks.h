#pragma once
// Checks of a frame before it is written and after it is read.
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::vdb {

// The domain of a frame: from voxel 0 to the highest upper of all blocks.
std::array<int, 3> domain_cells(const Frame& frame);

std::size_t voxel_count(const std::array<int, 3>& lower, const std::array<int, 3>& upper);

// Floats per voxel: 1, or 3 for a vector.
int components(GridKind kind);

// Throws Error(bug) if the number of a block's values does not match its box or an index is negative.
void require_block(const Grid& grid, const Block& block);

// Throws Error(cannot_continue) naming the grid and voxel of a value that is not finite.
void require_finite(const Grid& grid, const Block& block);

// Throws Error(bad_input) if a grid that was read holds a value that is not finite.
void require_finite(const std::filesystem::path& file, const Grid& grid);

// Throws Error(bad_input) if the file is missing, a folder or empty.
void require_readable(const std::filesystem::path& file);

// Throws Error(bad_input) if no run of Seiche could have written the domain in the file's metadata.
void require_sane(const std::filesystem::path& file, const Frame& frame, const std::array<int, 3>& cells);

// Throws Error(bad_input) "file: what".
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);

}  // namespace seiche::vdb
