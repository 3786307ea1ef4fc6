#pragma once
// Level sets closed at the sides of the domain: max(phi, distance from the sides).
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::vdb {

// Layers of voxels beyond the domain that a closed level set has.
inline constexpr int closing_layers = 3;

// Signed distance (m) from the sides of a domain of `cells` of size h at the centre of a voxel; negative inside. In 2D
// from the sides along x and y.
double distance_from_sides(const std::array<int, 3>& cells, int dimension, double h, const std::array<int, 3>& voxel);

// The block closed at the sides, with layers of voxels beyond those that it touches. phi is constant beyond the
// outermost voxels.
Block closed_at_sides(const Block& block, const std::array<int, 3>& cells, int dimension, double h);

}  // namespace seiche::vdb
