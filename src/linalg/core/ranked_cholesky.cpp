#include "linalg/core/ranked_cholesky.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

// Pivots up to this, of a unit diagonal, wait for the end.
constexpr double small_pivot = 1e-3;
// A matrix with more entries than this share is not worth sparse elimination.
constexpr double dense_share = 0.25;

// Cholesky factor with complete pivoting: A(order, order) ~ L L'. Each step takes the row of the largest remaining
// diagonal entry, and the last one is followed by entries up to `least`.
struct PivotedCholesky {
  std::vector<int> order;
  Eigen::MatrixXd L;

  PivotedCholesky(const Eigen::MatrixXd& A, double least) {
    const Eigen::Index n = A.rows();
    Eigen::MatrixXd columns(n, n);
    Eigen::VectorXd left = A.diagonal();
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::Index pivot = 0;
      if (left.maxCoeff(&pivot) <= least) break;
      columns.col(k) = A.col(pivot);
      columns.col(k).noalias() -= columns.leftCols(k) * columns.row(pivot).head(k).transpose();
      columns.col(k) /= std::sqrt(left[pivot]);
      left -= columns.col(k).cwiseAbs2();
      left[pivot] = 0;
      order.push_back(int(pivot));
    }
    const auto rank = Eigen::Index(order.size());
    L.setZero(rank, rank);
    for (Eigen::Index k = 0; k < rank; ++k) L.row(k).head(k + 1) = columns.row(order[std::size_t(k)]).head(k + 1);
  }
};

std::vector<int> minimum_degree(const SparseMatrix& A) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
  Eigen::AMDOrdering<int>()(A, inverse);
  return {inverse.indices().data(), inverse.indices().data() + inverse.indices().size()};
}

}  // namespace

RankedCholesky::RankedCholesky(const SparseMatrix& A, double dependent) {
  const auto n = int(A.rows());
  if (double(A.nonZeros()) < dense_share * n * n) {
    eliminate(A, minimum_degree(A));
  } else {
    for (int i = 0; i < n; ++i) waiting_.push_back(i);
  }
  finish(A, dependent);
  for (const Column& column : columns_) order_.push_back(column.pivot);
  order_.insert(order_.end(), last_.begin(), last_.end());
}

// Column by column: that of A less the part of the columns before it.
void RankedCholesky::eliminate(const SparseMatrix& A, const std::vector<int>& order) {
  const auto n = std::size_t(A.rows());
  std::vector<double> column(n, 0.0);
  std::vector<char> done(n, 0), present(n, 0);
  std::vector<std::vector<std::pair<int, double>>> row(n);  // of L so far: column and value
  std::vector<int> pattern;
  const auto add = [&](int i, double by) {
    if (done[std::size_t(i)]) return;
    if (!present[std::size_t(i)]) present[std::size_t(i)] = 1, pattern.push_back(i);
    column[std::size_t(i)] += by;
  };
  for (const int k : order) {
    pattern.clear();
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) add(int(it.row()), it.value());
    for (const auto& [j, factor] : row[std::size_t(k)]) {
      const Column& before = columns_[std::size_t(j)];
      for (std::size_t m = 0; m < before.rows.size(); ++m) add(before.rows[m], -factor * before.values[m]);
    }
    const double pivot = column[std::size_t(k)];
    if (pivot > small_pivot) {
      Column own{k, std::sqrt(pivot), {}, {}};
      done[std::size_t(k)] = 1;
      for (const int i : pattern) {
        if (i == k) continue;
        own.rows.push_back(i);
        own.values.push_back(column[std::size_t(i)] / own.diagonal);
        row[std::size_t(i)].emplace_back(int(columns_.size()), own.values.back());
      }
      columns_.push_back(std::move(own));
    } else {
      waiting_.push_back(k);
    }
    for (const int i : pattern) column[std::size_t(i)] = 0, present[std::size_t(i)] = 0;
  }
}

// The Schur complement of the rows that wait.
void RankedCholesky::finish(const SparseMatrix& A, double dependent) {
  std::vector<int> place(std::size_t(A.rows()), -1);
  for (std::size_t i = 0; i < waiting_.size(); ++i) place[std::size_t(waiting_[i])] = int(i);
  const auto n = Eigen::Index(waiting_.size());
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (SparseMatrix::InnerIterator it(A, waiting_[std::size_t(k)]); it; ++it)
      if (const int i = place[std::size_t(it.row())]; i >= 0) S(i, k) = it.value();
  std::vector<std::pair<int, double>> part;
  for (Column& column : columns_) {
    part.clear();
    for (std::size_t m = 0; m < column.rows.size(); ++m)
      if (const int i = place[std::size_t(column.rows[m])]; i >= 0) part.emplace_back(i, column.values[m]);
    for (const auto& [i, a] : part)
      for (const auto& [j, b] : part) S(i, j) -= a * b;
  }
  PivotedCholesky factor(S, dependent);
  for (const int i : factor.order) last_.push_back(waiting_[std::size_t(i)]);
  L_ = std::move(factor.L);
}

void RankedCholesky::solve_in_place(Eigen::MatrixXd& B) const {
  for (Eigen::Index c = 0; c < B.cols(); ++c) {
    auto b = B.col(c);
    for (const Column& column : columns_) {
      const double y = b[column.pivot] /= column.diagonal;
      if (y == 0) continue;
      for (std::size_t m = 0; m < column.rows.size(); ++m) b[column.rows[m]] -= column.values[m] * y;
    }
    Eigen::VectorXd end = b(last_);
    L_.triangularView<Eigen::Lower>().solveInPlace(end);
    L_.triangularView<Eigen::Lower>().transpose().solveInPlace(end);
    b(waiting_).setZero();
    b(last_) = end;
    for (auto column = columns_.rbegin(); column != columns_.rend(); ++column) {
      double y = b[column->pivot];
      for (std::size_t m = 0; m < column->rows.size(); ++m) y -= column->values[m] * b[column->rows[m]];
      b[column->pivot] = y / column->diagonal;
    }
  }
}

}  // namespace seiche
