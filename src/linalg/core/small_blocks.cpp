#include "linalg/core/small_blocks.h"

#include <algorithm>

namespace seiche {

bool SmallBlocks::factor(const SparseMatrix& H, const std::vector<std::vector<int>>& blocks) {
  blocks_.clear();
  blocks_.reserve(blocks.size());
  for (const std::vector<int>& rows : blocks) {
    const auto n = Eigen::Index(rows.size());
    Matrix own = Matrix::Zero(n, n);
    for (Eigen::Index k = 0; k < n; ++k)
      for (SparseMatrix::InnerIterator it(H, rows[std::size_t(k)]); it; ++it) {
        const auto found = std::lower_bound(rows.begin(), rows.end(), int(it.row()));
        if (found != rows.end() && *found == it.row()) own(found - rows.begin(), k) = it.value();
      }
    blocks_.push_back({rows, Eigen::LLT<Matrix>(own)});
    if (blocks_.back().factor.info() != Eigen::Success) return false;
  }
  return true;
}

Eigen::VectorXd SmallBlocks::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  for (const Block& block : blocks_) {
    Column own = b(block.rows);
    block.factor.solveInPlace(own);
    x(block.rows) = own;
  }
  return x;
}

Eigen::MatrixXd SmallBlocks::solve_columns(const Eigen::MatrixXd& B) const {
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(B.rows(), B.cols());
  for (Eigen::Index c = 0; c < B.cols(); ++c) X.col(c) = solve(B.col(c));
  return X;
}

void SmallBlocks::append_solved(const SparseMatrix& C, std::vector<Eigen::Triplet<double>>& entries) const {
  std::vector<std::pair<int, Column>> columns;  // of C' within a block
  for (const Block& block : blocks_) {
    const auto n = Eigen::Index(block.rows.size());
    columns.clear();
    for (Eigen::Index k = 0; k < n; ++k)
      for (SparseMatrix::InnerIterator it(C, block.rows[std::size_t(k)]); it; ++it) {
        auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.first == it.row(); });
        if (found == columns.end()) found = columns.emplace(found, int(it.row()), Column::Zero(n));
        found->second[k] = it.value();
      }
    for (auto& [column, x] : columns) {
      block.factor.solveInPlace(x);
      for (Eigen::Index i = 0; i < n; ++i) entries.emplace_back(block.rows[std::size_t(i)], column, x[i]);
    }
  }
}

}  // namespace seiche
