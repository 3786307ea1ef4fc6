#pragma once
// Signed distances sampled on voxels.
#include <array>
#include <memory>

#include "base/vec.h"

namespace seiche::vdb {

// A sampled signed distance (trilinear between voxels), constant +-band outside the narrow band.
class SampledDistance {
 public:
  virtual ~SampledDistance() = default;
  virtual double operator()(const Vec3& x) const = 0;
};

struct Frame;

// A frame's level set, constant beyond the outermost cell centres. Outside the domain it is at least the distance from
// it.
std::unique_ptr<SampledDistance> within_domain(std::unique_ptr<SampledDistance> distance, const Frame& frame,
                                               const std::array<int, 3>& cells);

}  // namespace seiche::vdb
