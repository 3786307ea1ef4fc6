#pragma once
// Entries of a distributed matrix that ranks find which do not have the row.
#include <vector>

#include "base/communicator.h"
#include "linalg/core/distributed_matrix.h"

namespace seiche {

struct MatrixEntry {
  Row row, column;
  double value;
};

// Those of all ranks whose row is one of [first, first + count), ordered by row and column, those of one place added
// up. Collective.
std::vector<MatrixEntry> send_to_owner(const std::vector<MatrixEntry>& mine, Row first, std::size_t count,
                                       const Communicator& ranks);

// The same, but for sums that are no more than the rounding of what was added up.
std::vector<MatrixEntry> send_sums_to_owner(const std::vector<MatrixEntry>& mine, Row first, std::size_t count,
                                            const Communicator& ranks);

}  // namespace seiche
