#pragma once
// Small diagonal blocks of a sparse matrix, which nothing couples: rigid bodies that do not touch.
#include <array>
#include <vector>

#include <Eigen/Cholesky>

#include "linalg/core/sparse_cholesky.h"

namespace seiche {

class SmallBlocks {
 public:
  static constexpr int most = 6;  // unknowns of a block

  // Factors the blocks of H in these rows, each ascending. False if one is not positive definite.
  [[nodiscard]] bool factor(const SparseMatrix& H, const std::vector<std::vector<int>>& blocks);
  // H^-1 b in the rows of the blocks; other rows stay 0.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;
  // Appends the entries of H^-1 C' in the rows of the blocks.
  void append_solved(const SparseMatrix& C, std::vector<Eigen::Triplet<double>>& entries) const;

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
  struct Block {
    std::vector<int> rows;
    Eigen::LLT<Matrix> factor;
  };
  std::vector<Block> blocks_;
};

}  // namespace seiche
