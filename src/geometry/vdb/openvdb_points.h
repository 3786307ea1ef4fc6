#pragma once
// Points of frames as OpenVDB keeps them; for openvdb_adapter.cpp.
#include <openvdb/openvdb.h>

#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::vdb {

// The points of a frame under a transform that stands for the frame's: voxel i at first + i h.
openvdb::GridBase::Ptr point_grid(const Frame& frame, const openvdb::math::Transform::Ptr& transform);

bool holds_points(const openvdb::GridBase& grid);

// Throws Error(bad_input) if the grid lacks what Seiche writes, or holds a value that is not finite.
std::vector<Point> read_points(const std::filesystem::path& file, const Frame& frame, const openvdb::GridBase& grid);

}  // namespace seiche::vdb
