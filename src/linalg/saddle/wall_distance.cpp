#include "linalg/saddle/wall_distance.h"

#include <algorithm>

namespace seiche {
namespace {

// Flags rows with links to walls at rest. Applied to velocities that are 1 along one axis, F leaves the mass and these
// links.
std::vector<char> rows_at_walls(const LinearSystem& F, const std::vector<int>& axis, const Vector& mass, int axes) {
  constexpr double part = 0.05;  // a link to a wall is at least a fifth of the diagonal
  std::vector<char> at_wall(mass.size(), 0);
  Vector along(mass.size()), F_along(mass.size());
  for (int a = 0; a < axes; ++a) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = axis.empty() || axis[i] == a;
    F.multiply(along, F_along);
    for (std::size_t i = 0; i < along.size(); ++i)
      if (along[i] != 0) at_wall[i] = F_along[i] - mass[i] > part * (F.diagonal(int(i)) - mass[i]);
  }
  return at_wall;
}

}  // namespace

std::vector<int> rows_from_walls(const LinearSystem& F, const std::vector<int>& axis, const Vector& mass, int most) {
  const DistributedMatrix& P = F.pattern();
  const int highest = axis.empty() ? 0 : *std::max_element(axis.begin(), axis.end());
  const std::vector<char> at_wall = rows_at_walls(F, axis, mass, 1 + int(F.ranks().global_max(std::int64_t(highest))));
  const std::size_t with_ghosts = mass.size() + std::size_t(F.halo().ghosts());
  Vector distance(with_ghosts, most), along(with_ghosts, 0.0);
  std::copy(axis.begin(), axis.end(), along.begin());
  F.halo().fill_ghosts(along);
  for (int d = 1; d < most; ++d) {
    const Vector before = distance;
    for (int i = 0; i < F.rows(); ++i) {
      if (before[std::size_t(i)] < d) continue;
      bool reached = d == 1 && at_wall[std::size_t(i)];
      for (int k = P.row_start[i] + 1; k < P.row_start[i + 1] && d > 1 && !reached; ++k) {
        const auto j = std::size_t(F.halo().local_index(P.column[std::size_t(k)]));
        reached = along[j] == along[std::size_t(i)] && before[j] == d - 1;
      }
      if (reached) distance[std::size_t(i)] = d;
    }
    F.halo().fill_ghosts(distance);
  }
  return {distance.begin(), distance.begin() + F.rows()};
}

}  // namespace seiche
