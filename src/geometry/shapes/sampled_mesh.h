#pragma once
// The signed distance of a closed mesh on voxels near the places where it is asked for.
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/mesh/distance.h"
#include "geometry/vdb/sampled_distance.h"

namespace seiche {

// Trilinear between the voxels i * voxel, limited to +-half_width voxels. Voxels are computed in blocks when a point in
// them is first asked for: the cost follows the places asked for, however large the mesh is in voxels.
class SampledMesh : public vdb::SampledDistance {
 public:
  SampledMesh(SurfaceMesh mesh, double voxel, double half_width);  // m, voxels
  // One thread at a time.
  double operator()(const Vec3& x) const override;
  std::size_t block_count() const { return blocks_.size(); }

 private:
  using Index = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Index& i) const;
  };
  // Distances of the voxels of a block, first axis fastest, m; a single one where all are the same.
  using Block = std::vector<float>;

  double at(const Index& voxel) const;
  Block make_block(const Index& block) const;
  Block fill_block(const Index& block) const;

  SurfaceMesh mesh_;
  mesh::NearestTriangle nearest_;
  double voxel_, band_;
  Vec3 lower_, upper_;  // beyond them the distance is the band's, m
  mutable std::unordered_map<Index, Block, Hash> blocks_;
  mutable Index last_index_{};
  mutable const Block* last_ = nullptr;
};

}  // namespace seiche
