#include "linalg/core/column_halo.h"

#include <algorithm>
#include <cassert>

namespace seiche {
namespace {

constexpr int request_tag = 7101, value_tag = 7102;

std::vector<Row> foreign_columns(const DistributedMatrix& A, Row first, int owned) {
  std::vector<Row> ghosts;
  for (const Row c : A.column) {
    if (c < first || c >= first + owned) ghosts.push_back(c);
  }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  return ghosts;
}

// First row of each rank, followed by the total number of rows.
std::vector<Row> gather_row_starts(int owned, const Communicator& ranks) {
  std::vector<std::int64_t> counts(ranks.size());
  const std::int64_t mine = owned;
  MPI_Allgather(&mine, 1, MPI_INT64_T, counts.data(), 1, MPI_INT64_T, ranks.handle());
  std::vector<Row> starts{0};
  for (const auto count : counts) starts.push_back(starts.back() + count);
  return starts;
}

}  // namespace

ColumnHalo::ColumnHalo(const DistributedMatrix& A, const Communicator& ranks)
    : ColumnHalo(A, A.first_row, A.rows(), ranks) {}

ColumnHalo::ColumnHalo(const DistributedMatrix& A, Row first, int owned, const Communicator& ranks)
    : ranks_(ranks), first_row_(first), owned_(owned), ghost_rows_(foreign_columns(A, first, owned)) {
  if (ranks.size() == 1) {
    assert(ghost_rows_.empty());
    return;
  }
  const std::vector<Row> starts = gather_row_starts(owned_, ranks);
  assert(owned_ == 0 || starts[ranks.rank()] == first_row_);
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const auto low = std::lower_bound(ghost_rows_.begin(), ghost_rows_.end(), starts[rank]);
    const auto high = std::lower_bound(low, ghost_rows_.end(), starts[rank + 1]);
    if (high > low) receive_.push_back({rank, int(low - ghost_rows_.begin()), int(high - low)});
  }
  ask_owners(starts);
}

void ColumnHalo::ask_owners(const std::vector<Row>& row_starts) {
  std::vector<int> wanted(ranks_.size(), 0), asked(ranks_.size(), 0);
  for (const Peer& peer : receive_) wanted[peer.rank] = peer.count;
  MPI_Alltoall(wanted.data(), 1, MPI_INT, asked.data(), 1, MPI_INT, ranks_.handle());
  int total = 0;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    if (asked[rank] > 0) send_.push_back({rank, total, asked[rank]});
    total += asked[rank];
  }
  std::vector<Row> rows(total);
  std::vector<MPI_Request> requests(send_.size() + receive_.size());
  auto request = requests.data();
  for (const Peer& p : send_) {
    MPI_Irecv(&rows[p.first], p.count, MPI_INT64_T, p.rank, request_tag, ranks_.handle(), request++);
  }
  for (const Peer& p : receive_) {
    MPI_Isend(&ghost_rows_[p.first], p.count, MPI_INT64_T, p.rank, request_tag, ranks_.handle(), request++);
  }
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (const Row row : rows) sent_.push_back(int(row - row_starts[ranks_.rank()]));
  send_buffer_.resize(sent_.size());
}

int ColumnHalo::local_index(Row global) const {
  if (global >= first_row_ && global < first_row_ + owned_) return int(global - first_row_);
  const auto at = std::lower_bound(ghost_rows_.begin(), ghost_rows_.end(), global);
  assert(at != ghost_rows_.end() && *at == global);
  return owned_ + int(at - ghost_rows_.begin());
}

void ColumnHalo::fill_ghosts(std::span<double> x) const {
  assert(int(x.size()) == owned_ + ghosts());
  for (std::size_t i = 0; i < sent_.size(); ++i) send_buffer_[i] = x[sent_[i]];
  std::vector<MPI_Request> requests(send_.size() + receive_.size());
  auto request = requests.data();
  for (const Peer& p : receive_) {
    MPI_Irecv(&x[owned_ + p.first], p.count, MPI_DOUBLE, p.rank, value_tag, ranks_.handle(), request++);
  }
  for (const Peer& p : send_) {
    MPI_Isend(&send_buffer_[p.first], p.count, MPI_DOUBLE, p.rank, value_tag, ranks_.handle(), request++);
  }
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}  // namespace seiche
