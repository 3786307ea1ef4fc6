#include "linalg/core/shared_columns.h"

#include <cstdint>

#include "linalg/core/block_columns.h"

namespace seiche {

IndexRange share_of_rank(int n, const Communicator& ranks) {
  const auto cut = [&](int rank) { return int(std::int64_t(n) * rank / ranks.size()); };
  return {cut(ranks.rank()), cut(ranks.rank() + 1)};
}

void RankShare::add_up(std::span<double> values) const {
  Eigen::VectorXd sums = Eigen::Map<Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
  ranks_.global_sum(std::span<double>(sums.data(), values.size()));
  make_identical(sums, ranks_);
  std::copy(sums.begin(), sums.end(), values.begin());
}

SparseMatrix with_columns(const SparseMatrix& H, IndexRange own) {
  if (own.size() == H.cols()) return H;
  SparseMatrix part(H.rows(), H.cols());
  part.reserve(H.outerIndexPtr()[own.end] - H.outerIndexPtr()[own.begin]);
  for (int k = 0; k < H.cols(); ++k) {
    part.startVec(k);
    if (!own.holds(k)) continue;
    for (SparseMatrix::InnerIterator it(H, k); it; ++it) part.insertBack(it.row(), k) = it.value();
  }
  part.finalize();
  return part;
}

// Each sum has a single nonzero term, so there is no rounding.
void collect_shares(Eigen::VectorXd& v, const Communicator& ranks) {
  if (ranks.size() == 1) return;
  const IndexRange own = share_of_rank(int(v.size()), ranks);
  v.head(own.begin).setZero();
  v.tail(v.size() - own.end).setZero();
  ranks.global_sum(std::span<double>(v.data(), std::size_t(v.size())));
}

Eigen::VectorXd multiply_shared(const SparseMatrix& H, const Eigen::VectorXd& v, const Communicator& ranks) {
  Eigen::VectorXd product(v.size());
  const IndexRange own = share_of_rank(int(v.size()), ranks);
  for (int k = own.begin; k < own.end; ++k) product[k] = H.col(k).dot(v);
  collect_shares(product, ranks);
  return product;
}

Eigen::VectorXd shared_diagonal(const SparseMatrix& H, const Communicator& ranks) {
  Eigen::VectorXd diagonal = H.diagonal();
  collect_shares(diagonal, ranks);
  return diagonal;
}

}  // namespace seiche
