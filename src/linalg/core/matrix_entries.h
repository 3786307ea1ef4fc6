#pragma once
// Exchange of matrix entries that were computed on ranks that do not own their rows.
#include <vector>

#include "base/communicator.h"
#include "linalg/core/distributed_matrix.h"

namespace seiche {

struct MatrixEntry {
  Row row, column;
  double value;
};

// Entries of all ranks in rows [first, first + count), ordered by row and column; entries of one position are summed.
// Collective.
std::vector<MatrixEntry> send_to_owner(const std::vector<MatrixEntry>& mine, Row first, std::size_t count,
                                       const Communicator& ranks);

// As send_to_owner(), but drops sums no larger than 1e-12 of the sum of the absolute values (round-off). Collective.
std::vector<MatrixEntry> send_sums_to_owner(const std::vector<MatrixEntry>& mine, Row first, std::size_t count,
                                            const Communicator& ranks);

}  // namespace seiche
