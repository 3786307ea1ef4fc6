#pragma once
// Forces on solids, added up over the ranks.
#include <vector>

#include "base/communicator.h"
#include "fluid/viscosity/viscosity.h"

namespace seiche {

// Loads on solids that are known before a solve, one entry a solid each, or empty: by stress, and of fluid that moves
// with the solids. `carried`: inertia of that fluid (force and torque about the solid's reference point).
struct KnownLoads {
  std::vector<SolidLoad> stress, carrying;
  std::vector<Eigen::Matrix<double, 6, 6>> carried;
};

class LoadSums {
 public:
  // `about`: one point a solid, m.
  explicit LoadSums(std::vector<Vec3> about) : about_(std::move(about)), sums_(6 * about_.size()) {}

  // A force (N) at x (m) on solid k.
  void add(int k, const Vec3& x, const Vec3& force) {
    const auto n = std::size_t(k);
    const Vec3 torque = (x - about_[n]).cross(force);
    for (int c = 0; c < 3; ++c)
      sums_[6 * n + std::size_t(c)] += force[c], sums_[6 * n + 3 + std::size_t(c)] += torque[c];
  }
  // Collective.
  std::vector<SolidLoad> total(const Communicator& ranks) const {
    std::vector<double> sums = sums_;
    if (!sums.empty()) ranks.global_sum(sums);
    std::vector<SolidLoad> loads(about_.size());
    for (std::size_t k = 0; k < loads.size(); ++k) loads[k] = {Vec3(&sums[6 * k]), Vec3(&sums[6 * k + 3])};
    return loads;
  }

 private:
  std::vector<Vec3> about_;
  std::vector<double> sums_;
};

// loads += more; either may be empty.
inline void add_loads(const std::vector<SolidLoad>& more, std::vector<SolidLoad>& loads) {
  loads.resize(std::max(loads.size(), more.size()));
  for (std::size_t k = 0; k < more.size(); ++k) loads[k].force += more[k].force, loads[k].torque += more[k].torque;
}

}  // namespace seiche
