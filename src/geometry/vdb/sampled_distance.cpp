#include "geometry/vdb/sampled_distance.h"

#include <algorithm>
#include <utility>

#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::vdb {
namespace {

class WithinDomain : public SampledDistance {
 public:
  WithinDomain(std::unique_ptr<SampledDistance> inner, const Frame& frame, const std::array<int, 3>& cells)
      : inner_(std::move(inner)),
        lower_(frame.lower),
        half_(Vec3::Constant(frame.cell_size / 2)),
        upper_(lower_ + frame.cell_size * Vec3(cells[0], cells[1], cells[2])),
        dimension_(frame.dimension) {}

  double operator()(const Vec3& x) const override {
    const double inside = (*inner_)(x.cwiseMin(upper_ - half_).cwiseMax(lower_ + half_));
    const double outside = (lower_ - x).cwiseMax(x - upper_).cwiseMax(0.0).head(dimension_).norm();
    return outside > 0 ? std::max(inside, outside) : inside;
  }

 private:
  std::unique_ptr<SampledDistance> inner_;
  Vec3 lower_, half_, upper_;
  int dimension_;
};

}  // namespace

std::unique_ptr<SampledDistance> within_domain(std::unique_ptr<SampledDistance> distance, const Frame& frame,
                                               const std::array<int, 3>& cells) {
  return std::make_unique<WithinDomain>(std::move(distance), frame, cells);
}

}  // namespace seiche::vdb
