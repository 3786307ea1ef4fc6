#include "linalg/spd/body_coupling.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "linalg/core/sparse_inverse.h"

namespace seiche {
namespace {

struct Entry {
  Row row;
  std::int64_t column;
  double value;
};

// This rank's entries of the deformable blocks of J. Identity rows of A are left out.
std::vector<Entry> local_entries(const LinearSystem& A, const BlockColumns& J) {
  std::vector<char> is_identity(std::size_t(A.rows()), 0);
  for (const int i : A.identity_list()) is_identity[std::size_t(i)] = 1;
  std::vector<Entry> entries;
  std::int64_t first = 0;
  for (const ColumnBlock& b : J.blocks) {
    if (b.deforms())
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

// Rows that bodies touch, over all ranks, ascending.
std::vector<Row> touched_rows(const std::vector<Entry>& entries) {
  std::vector<Row> rows;
  for (const Entry& e : entries) rows.push_back(e.row);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

int index_of(const std::vector<Row>& rows, Row row) {
  const auto found = std::lower_bound(rows.begin(), rows.end(), row);
  return found != rows.end() && *found == row ? int(found - rows.begin()) : -1;
}

// Drops off-diagonal entries below this fraction of the diagonal: nine in ten of them, at no cost in iterations.
constexpr double worth_keeping = 0.02;

void drop_small(SparseMatrix& M) {
  const Eigen::VectorXd d = M.diagonal().cwiseSqrt();
  M.prune(
      [&](Eigen::Index i, Eigen::Index j, double v) { return i == j || std::abs(v) > worth_keeping * d[i] * d[j]; });
}

// J G'G J' on the touched rows.
SparseMatrix coupling_of(const std::vector<Entry>& entries, const std::vector<Row>& rows, const SparseMatrix& H) {
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<char> wanted(std::size_t(H.rows()), 0);
  for (const Entry& e : entries) {
    triplets.emplace_back(index_of(rows, e.row), int(e.column), e.value);
    wanted[std::size_t(e.column)] = 1;
  }
  SparseMatrix J(Eigen::Index(rows.size()), H.rows());
  J.setFromTriplets(triplets.begin(), triplets.end());
  const SparseMatrix G = sparse_inverse_factor(H, wanted), W = J * SparseMatrix(G.transpose());
  SparseMatrix M = W * SparseMatrix(W.transpose());
  drop_small(M);
  return M;
}

}  // namespace

DistributedMatrix add_body_coupling(const LinearSystem& A, const BlockColumns& J, const SparseMatrix& H, double c) {
  const std::vector<Entry> entries = of_all_ranks(local_entries(A, J), A.ranks());
  const std::vector<Row> rows = touched_rows(entries);
  const SparseMatrix C = coupling_of(entries, rows, H);
  const DistributedMatrix& P = A.pattern();
  DistributedMatrix M;
  M.first_row = P.first_row;
  M.global_rows = P.global_rows;
  for (int i = 0; i < A.rows(); ++i) {
    const Row own = P.first_row + i;
    std::map<Row, double> row;  // the diagonal has key -1, so that it comes first
    const auto add = [&](Row column, double value) { row[column == own ? -1 : column] += value; };
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) add(P.column[k], A.values()[k]);
    if (const int m = index_of(rows, own); m >= 0)
      for (SparseMatrix::InnerIterator it(C, m); it; ++it) add(rows[std::size_t(it.row())], c * it.value());
    for (const auto& [column, value] : row) M.column.push_back(column < 0 ? own : column), M.value.push_back(value);
    M.row_start.push_back(int(M.column.size()));
  }
  return M;
}

bool has_changed_much(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& before) {
  constexpr double much = 4;
  const Eigen::ArrayXd change = diagonal.array() / before.array();
  return change.maxCoeff() > much || change.minCoeff() < 1 / much;
}

}  // namespace seiche
