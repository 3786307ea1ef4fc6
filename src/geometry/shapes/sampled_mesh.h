#pragma once
// The signed distance of a closed mesh, sampled on voxels on demand.
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/mesh/distance.h"
#include "geometry/vdb/sampled_distance.h"

namespace seiche {

// Trilinear between samples at i * voxel, limited to +-half_width voxels. Samples are computed in blocks when a point
// in a block is first queried. The cost depends on the queried region, not on the size of the mesh.
class SampledMesh : public vdb::SampledDistance {
 public:
  SampledMesh(SurfaceMesh mesh, double voxel, double half_width);  // m, voxels
  // Must be called by one thread at a time.
  double operator()(const Vec3& x) const override;
  std::size_t block_count() const { return blocks_.size(); }

 private:
  using Index = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Index& i) const;
  };
  // Distances of the voxels of a block, first axis fastest, m; a single value if all are equal.
  using Block = std::vector<float>;

  double at(const Index& voxel) const;
  Block make_block(const Index& block) const;
  Block fill_block(const Index& block) const;

  SurfaceMesh mesh_;
  mesh::NearestTriangle nearest_;
  double voxel_, band_;
  Vec3 lower_, upper_;  // outside this box the distance is +band_, m
  mutable std::unordered_map<Index, Block, Hash> blocks_;
  mutable Index last_index_{};
  mutable const Block* last_ = nullptr;
};

}  // namespace seiche
