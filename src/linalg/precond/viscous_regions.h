#pragma once
// Connected parts of a matrix whose diagonal is large beside that of what surrounds them.
#include <cstdint>

#include "linalg/core/linear_system.h"

namespace seiche {

struct ViscousRegion {
  Row first;             // the lowest of its rows, over all ranks
  std::int64_t size;     // over all ranks
  std::vector<int> row;  // of this rank, ascending
};

// Rows joined by entries of the size of their diagonals, at several levels below the largest diagonal: regions are
// nested or apart. At most `most`, the largest of those that have `fewest` rows; the same on any number of ranks.
// Collective.
std::vector<ViscousRegion> find_viscous_regions(const LinearSystem& F, int fewest, std::size_t most);

}  // namespace seiche
