#pragma once
// High-viscosity regions: connected sets of rows whose diagonal is large compared to that of surrounding rows.
#include <cstdint>

#include "linalg/core/linear_system.h"

namespace seiche {

struct ViscousRegion {
  Row first;             // its lowest row, over all ranks
  std::int64_t size;     // over all ranks
  std::vector<int> row;  // local rows, ascending
};

// Finds sets of rows that are connected by entries comparable to their diagonals, at several levels below the largest
// diagonal. Regions are nested or disjoint. Returns at most `most` regions, the largest of those with at least `fewest`
// rows. The result is the same on any number of ranks. Collective.
std::vector<ViscousRegion> find_viscous_regions(const LinearSystem& F, int fewest, std::size_t most);

}  // namespace seiche
