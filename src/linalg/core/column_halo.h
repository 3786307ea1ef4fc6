#pragma once
// The entries of a distributed vector that this rank's matrix rows refer to while another rank owns them.
#include <span>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/distributed_matrix.h"

namespace seiche {

class ColumnHalo {
 public:
  // Collective. Rows must be numbered in the order of the ranks, without gaps.
  ColumnHalo(const DistributedMatrix& A, const Communicator& ranks);
  // Of a rectangular matrix: the vector it is multiplied with has `owned` entries here, numbered from `first`.
  ColumnHalo(const DistributedMatrix& A, Row first, int owned, const Communicator& ranks);

  int owned() const { return owned_; }
  int ghosts() const { return int(ghost_rows_.size()); }

  // The place of a global row in a vector of owned() entries followed by ghosts().
  int local_index(Row global) const;

  // Fills the ghosts of x, which holds owned() + ghosts() entries, from the ranks that own them. Collective.
  void fill_ghosts(std::span<double> x) const;

 private:
  struct Peer {
    int rank;
    int first, count;  // its part of the ghosts, or of sent_
  };
  void ask_owners(const std::vector<Row>& row_starts);

  Communicator ranks_;
  Row first_row_;
  int owned_;
  std::vector<Row> ghost_rows_;  // ascending, so the ghosts of one owner are contiguous
  std::vector<Peer> receive_, send_;
  std::vector<int> sent_;  // owned entries that others want, by peer
  mutable std::vector<double> send_buffer_;
};

}  // namespace seiche
