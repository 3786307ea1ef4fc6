#include "linalg/lumped_coupling.h"

#include <algorithm>
#include <cstring>

namespace seiche {
namespace {

struct Entry {
  Row row;
  std::int64_t column;
  double value;
};

// Of this rank. Rows of the identity are left to themselves.
std::vector<Entry> local_entries(const LinearSystem& A, const BlockColumns& J) {
  std::vector<char> is_identity(std::size_t(A.rows()), 0);
  for (const int i : A.identity_list()) is_identity[std::size_t(i)] = 1;
  std::vector<Entry> entries;
  std::int64_t first = 0;
  for (const ColumnBlock& b : J.blocks) {
    if (b.modes.size() > 0)
      b.for_each([&](int i, int k, double value) {
        if (value != 0 && !is_identity[std::size_t(i)])
          entries.push_back({A.pattern().first_row + i, first + k, value});
      });
    first += b.width;
  }
  return entries;
}

std::vector<Entry> of_all_ranks(const std::vector<Entry>& mine, const Communicator& ranks) {
  if (ranks.size() == 1) return mine;
  std::vector<Entry> all;
  for (const std::string& part :
       ranks.all_gather(std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(Entry)))) {
    const std::size_t before = all.size();
    all.resize(before + part.size() / sizeof(Entry));
    if (!part.empty()) std::memcpy(static_cast<void*>(all.data() + before), part.data(), part.size());
  }
  return all;
}

using RowEntries = std::vector<std::pair<Row, double>>;  // by column

// (J D^-1 J') of this rank's rows, columns of a row in no order and repeated.
std::vector<RowEntries> lumped_rows(const LinearSystem& A, const BlockColumns& J, const SparseMatrix& H, double c) {
  const std::vector<Entry> mine = local_entries(A, J);
  std::vector<Entry> all = of_all_ranks(mine, A.ranks());
  std::stable_sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
  std::vector<std::size_t> start(std::size_t(J.columns()) + 1, 0);
  for (const Entry& e : all) ++start[std::size_t(e.column) + 1];
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  const Eigen::VectorXd D = H.diagonal();
  std::vector<RowEntries> rows(std::size_t(A.rows()));
  for (const Entry& e : mine) {
    const auto k = std::size_t(e.column);
    for (std::size_t n = start[k]; n < start[k + 1]; ++n)
      rows[std::size_t(e.row - A.pattern().first_row)].emplace_back(all[n].row,
                                                                    c * e.value * all[n].value / D[e.column]);
  }
  return rows;
}

// Adds up what stands in one column; the diagonal first.
void append_row(RowEntries entries, Row diagonal, DistributedMatrix& M) {
  const auto place = [&](Row column) { return column == diagonal ? Row(-1) : column; };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const auto& a, const auto& b) { return place(a.first) < place(b.first); });
  for (std::size_t n = 0; n < entries.size(); ++n) {
    if (n > 0 && entries[n].first == entries[n - 1].first)
      M.value.back() += entries[n].second;
    else
      M.column.push_back(entries[n].first), M.value.push_back(entries[n].second);
  }
  M.row_start.push_back(int(M.column.size()));
}

}  // namespace

DistributedMatrix add_lumped_coupling(const LinearSystem& A, const BlockColumns& J, const SparseMatrix& H, double c) {
  std::vector<RowEntries> rows = lumped_rows(A, J, H, c);
  const DistributedMatrix& P = A.pattern();
  DistributedMatrix M;
  M.first_row = P.first_row;
  M.global_rows = P.global_rows;
  for (int i = 0; i < A.rows(); ++i) {
    RowEntries& row = rows[std::size_t(i)];
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) row.emplace_back(P.column[k], A.values()[k]);
    append_row(std::move(row), P.first_row + i, M);
  }
  return M;
}

}  // namespace seiche
