#include "linalg/spd/body_coupling.h"

#include <algorithm>
#include <cstring>

#include "linalg/core/shared_columns.h"
#include "linalg/core/sparse_inverse.h"

namespace seiche {

std::vector<CouplingEntry> of_all_ranks(const std::vector<CouplingEntry>& mine, const Communicator& ranks) {
  if (ranks.size() == 1) return mine;
  std::vector<CouplingEntry> all;
  for (const std::string& part :
       ranks.all_gather(std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(CouplingEntry)))) {
    const std::size_t before = all.size();
    all.resize(before + part.size() / sizeof(CouplingEntry));
    if (!part.empty()) std::memcpy(static_cast<void*>(all.data() + before), part.data(), part.size());
  }
  return all;
}

int index_of(const std::vector<Row>& rows, Row row) {
  const auto found = std::lower_bound(rows.begin(), rows.end(), row);
  return found != rows.end() && *found == row ? int(found - rows.begin()) : -1;
}

namespace {

// This rank's entries of the deformable blocks of J. Identity rows of A are left out.
std::vector<CouplingEntry> local_entries(const LinearSystem& A, const BlockColumns& J) {
  std::vector<char> is_identity(std::size_t(A.rows()), 0);
  for (const int i : A.identity_list()) is_identity[std::size_t(i)] = 1;
  std::vector<CouplingEntry> entries;
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

// Rows that bodies touch, over all ranks, ascending.
std::vector<Row> touched_rows(const std::vector<CouplingEntry>& entries) {
  std::vector<Row> rows;
  for (const CouplingEntry& e : entries) rows.push_back(e.row);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

// Drops off-diagonal entries below this fraction of the diagonal: nine in ten of them, at no cost in iterations.
constexpr double worth_keeping = 0.02;

void drop_small(SparseMatrix& M) {
  const Eigen::VectorXd d = M.diagonal().cwiseSqrt();
  M.prune(
      [&](Eigen::Index i, Eigen::Index j, double v) { return i == j || std::abs(v) > worth_keeping * d[i] * d[j]; });
}

// The unknowns that share an entry of H with one of `some`, and these. H is shared out. Collective.
std::vector<char> with_neighbours(const SparseMatrix& H, const std::vector<char>& some, const Communicator& ranks) {
  Eigen::VectorXd found = Eigen::VectorXd::Zero(H.cols());
  for (int k = 0; k < H.cols(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it)
      if (some[std::size_t(it.row())]) found[k] = 1;
  collect_shares(found, ranks);
  std::vector<char> all = some;
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = some[k] || found[Eigen::Index(k)] != 0;
  return all;
}

template <class Value>
void pack(const Value* values, std::size_t count, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

template <class Value>
std::size_t unpack(const std::string& bytes, std::size_t at, std::size_t count, std::vector<Value>& values) {
  values.resize(count);
  std::memcpy(values.data(), bytes.data() + at, count * sizeof(Value));
  return at + count * sizeof(Value);
}

// Number, length, rows and values of each column of H that is `wanted` here.
std::string packed_columns(const SparseMatrix& H, const std::vector<char>& wanted) {
  std::string bytes;
  for (int k = 0; k < H.cols(); ++k) {
    const int first = H.outerIndexPtr()[k], head[2] = {k, H.outerIndexPtr()[k + 1] - first};
    if (!wanted[std::size_t(k)] || head[1] == 0) continue;
    pack(head, 2, bytes);
    pack(H.innerIndexPtr() + first, std::size_t(head[1]), bytes);
    pack(H.valuePtr() + first, std::size_t(head[1]), bytes);
  }
  return bytes;
}

// The columns of H that sparse_inverse_factor() reads for the `wanted` ones, on all ranks: rows of G with a wanted
// column are those of its neighbours, and each needs the columns of its own neighbours. H is shared out in ascending
// ranges of columns. Collective.
SparseMatrix columns_around(const std::vector<char>& wanted, const SparseMatrix& H, const Communicator& ranks) {
  const std::vector<char> around = with_neighbours(H, with_neighbours(H, wanted, ranks), ranks);
  SparseMatrix part(H.rows(), H.cols());
  int column = 0;
  std::vector<int> head, rows;
  std::vector<double> values;
  for (const std::string& bytes : ranks.all_gather(packed_columns(H, around))) {
    part.reserve(Eigen::Index(bytes.size() / (sizeof(int) + sizeof(double))));
    for (std::size_t at = 0; at < bytes.size();) {
      at = unpack(bytes, at, 2, head);
      const auto count = std::size_t(head[1]);
      at = unpack(bytes, unpack(bytes, at, count, rows), count, values);
      while (column <= head[0]) part.startVec(column++);
      for (std::size_t n = 0; n < count; ++n) part.insertBack(rows[n], head[0]) = values[n];
    }
  }
  part.finalize();
  return part;
}

SparseMatrix inverse_factor_of(const BodyMatrix& H, const std::vector<char>& wanted, const Communicator& ranks) {
  if (!H.is_shared_out()) return sparse_inverse_factor(H.matrix(), wanted);
  return sparse_inverse_factor(columns_around(wanted, H.matrix(), ranks), wanted);
}

// J G'G J' on the touched rows.
SparseMatrix coupling_of(const std::vector<CouplingEntry>& entries, const std::vector<Row>& rows, const BodyMatrix& H,
                         const Communicator& ranks) {
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<char> wanted(std::size_t(H.size()), 0);
  for (const CouplingEntry& e : entries) {
    triplets.emplace_back(index_of(rows, e.row), int(e.column), e.value);
    wanted[std::size_t(e.column)] = 1;
  }
  SparseMatrix J(Eigen::Index(rows.size()), H.size());
  J.setFromTriplets(triplets.begin(), triplets.end());
  const SparseMatrix G = inverse_factor_of(H, wanted, ranks), W = J * SparseMatrix(G.transpose());
  SparseMatrix M = W * SparseMatrix(W.transpose());
  drop_small(M);
  return M;
}

}  // namespace

BodyCoupling body_coupling(const LinearSystem& A, const BlockColumns& J, const BodyMatrix& H, double c) {
  const std::vector<CouplingEntry> entries = of_all_ranks(local_entries(A, J), A.ranks());
  BodyCoupling C{touched_rows(entries), {}};
  C.matrix = c * coupling_of(entries, C.rows, H, A.ranks());
  return C;
}

// The diagonal comes first and the other columns ascend: BoomerAMG needs a fifth more iterations with other orders.
DistributedMatrix add_body_coupling(const LinearSystem& A, const BodyCoupling& C) {
  const DistributedMatrix& P = A.pattern();
  DistributedMatrix M;
  M.first_row = P.first_row;
  M.global_rows = P.global_rows;
  std::vector<std::pair<Row, double>> row;  // the diagonal has column -1
  for (int i = 0; i < A.rows(); ++i) {
    const Row own = P.first_row + i;
    row.clear();
    const auto add = [&](Row column, double value) { row.emplace_back(column == own ? -1 : column, value); };
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) add(P.column[k], A.values()[k]);
    if (const int m = index_of(C.rows, own); m >= 0)
      for (SparseMatrix::InnerIterator it(C.matrix, m); it; ++it) add(C.rows[std::size_t(it.row())], it.value());
    std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t n = 0; n < row.size();) {
      const Row column = row[n].first;
      double sum = 0;
      for (; n < row.size() && row[n].first == column; ++n) sum += row[n].second;
      M.column.push_back(column < 0 ? own : column), M.value.push_back(sum);
    }
    M.row_start.push_back(int(M.column.size()));
  }
  return M;
}

DistributedMatrix add_lumped_coupling(const LinearSystem& A, const BodyCoupling& C) {
  DistributedMatrix M = A.pattern();
  M.value = A.values();
  for (std::size_t m = 0; m < C.rows.size(); ++m) {
    const Row i = C.rows[m] - M.first_row;
    if (i < 0 || i >= A.rows()) continue;
    for (SparseMatrix::InnerIterator it(C.matrix, int(m)); it; ++it)
      M.value[std::size_t(M.row_start[std::size_t(i)])] += std::abs(it.value());
  }
  return M;
}

double coupling_strength(const LinearSystem& A, const BlockColumns& J, const Eigen::VectorXd& diagonal, double c) {
  std::vector<double> C(std::size_t(A.rows()), 0.0);
  const std::vector<int> first = J.first_columns();
  for (std::size_t b = 0; b < J.blocks.size(); ++b)
    if (J.blocks[b].deforms())
      J.blocks[b].for_each([&](int i, int k, double v) { C[std::size_t(i)] += c * v * v / diagonal[first[b] + k]; });
  double largest = 0;
  for (int i = 0; i < A.rows(); ++i)
    if (A.diagonal(i) > 0) largest = std::max(largest, C[std::size_t(i)] / A.diagonal(i));
  return A.ranks().global_max(largest);
}

bool has_changed_much(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& before) {
  constexpr double much = 4;
  const Eigen::ArrayXd change = diagonal.array() / before.array();
  return change.maxCoeff() > much || change.minCoeff() < 1 / much;
}

}  // namespace seiche
