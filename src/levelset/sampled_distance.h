#pragma once
// Sampled distances put together, and when a mesh is too large to be sampled.
#include "levelset/openvdb_adapter.h"

namespace seiche::vdb {

// Throws Error(bad_input) if the surface is too large for voxels of this size.
void require_sampleable(const SurfaceMesh& mesh, double voxel, double half_width);

// A frame's level set, constant beyond the outermost cell centres and outside the domain at least the distance to it.
std::unique_ptr<SampledDistance> within_domain(std::unique_ptr<SampledDistance> distance, const Frame& frame,
                                               const std::array<int, 3>& cells);

// Solids, less their cavities, plus the solids in those, and so on.
std::unique_ptr<SampledDistance> nest(std::vector<std::unique_ptr<SampledDistance>> levels);

}  // namespace seiche::vdb
