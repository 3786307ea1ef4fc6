#pragma once
// Ghost entries of a distributed vector: those that this rank's matrix rows refer to but another rank owns.
#include <span>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/distributed_matrix.h"

namespace seiche {

class ColumnHalo {
 public:
  // For a square matrix. Rows must be numbered in the order of the ranks, without gaps. Collective.
  ColumnHalo(const DistributedMatrix& A, const Communicator& ranks);
  // For a rectangular matrix: this rank owns `owned` entries of the vector it multiplies, numbered from `first`.
  // Collective.
  ColumnHalo(const DistributedMatrix& A, Row first, int owned, const Communicator& ranks);

  int owned() const { return owned_; }
  int ghosts() const { return int(ghost_rows_.size()); }

  // Index of a global row in a vector of owned() entries followed by ghosts().
  int local_index(Row global) const;

  // Fills the ghosts of x, which holds owned() + ghosts() entries, from the ranks that own them. Collective.
  void fill_ghosts(std::span<double> x) const;

 private:
  struct Peer {
    int rank;
    int first, count;  // range within the ghosts (receive_) or within sent_ (send_)
  };
  void ask_owners(const std::vector<Row>& row_starts);

  Communicator ranks_;
  Row first_row_;
  int owned_;
  std::vector<Row> ghost_rows_;  // ascending, so the ghosts of one owner are contiguous
  std::vector<Peer> receive_, send_;
  std::vector<int> sent_;  // owned entries that other ranks need, by peer
  mutable std::vector<double> send_buffer_;
};

}  // namespace seiche
