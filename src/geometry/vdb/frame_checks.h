#pragma once
// What a frame must satisfy before it is written or after it is read.
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::vdb {

// The domain of a frame: from voxel 0 to the highest upper of all blocks.
std::array<int, 3> domain_cells(const Frame& frame);

std::size_t voxel_count(const std::array<int, 3>& lower, const std::array<int, 3>& upper);

// Floats a voxel: 1, or 3 of a vector.
int components(GridKind kind);

// Throws Error(bug) if the values of a block do not fill its box.
void require_block(const Grid& grid, const Block& block);

// Throws Error(cannot_continue) naming the grid and voxel of a value that is not finite.
void require_finite(const Grid& grid, const Block& block);

// Throws Error(bad_input) if a grid that was read holds a value that is not finite.
void require_finite(const std::filesystem::path& file, const Grid& grid);

// Throws Error(bad_input) if the file is missing, a folder or empty.
void require_readable(const std::filesystem::path& file);

// Counts of a file are not trusted: throws Error(bad_input) on a domain that none of our runs could have written.
void require_sane(const std::filesystem::path& file, const Frame& frame, const std::array<int, 3>& cells);

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);

}  // namespace seiche::vdb
