#include "linalg/core/sparse_cholesky.h"

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

namespace sparse_cholesky_tests {
using namespace seiche;

namespace {

// Laplacian of n x n points plus `shift`, with a spring between the first point and point `tie`.
SparseMatrix springs(int n, double shift, int tie) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b) {
    for (const auto& [i, j, x] : {std::tuple{a, a, 1.0}, {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}})
      entries.emplace_back(i, j, x);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i + 1 < n) join(i * n + j, (i + 1) * n + j);
      if (j + 1 < n) join(i * n + j, i * n + j + 1);
      entries.emplace_back(i * n + j, i * n + j, shift);
    }
  join(0, tie);
  SparseMatrix A(n * n, n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Eigen::VectorXd ramp(Eigen::Index n) {
  return Eigen::VectorXd::LinSpaced(n, -1, 2);
}

Eigen::VectorXd solved(const SparseMatrix& A) {
  SparseCholesky factor;
  REQUIRE(factor.factor(A));
  return factor.solve(ramp(A.rows()));
}

}  // namespace

// 1e-11: the condition number is below 8/shift = 80.
TEST_CASE("a Cholesky factor made with an analysis of before solves its own matrix") {
  const int n = 40;
  const std::vector<SparseMatrix> matrices = {springs(n, 0.1, 700), springs(n, 0.1, 900), springs(n, 0.3, 700)};
  std::vector<Eigen::VectorXd> first;
  for (const SparseMatrix& A : matrices) first.push_back(solved(A));
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    CHECK((matrices[k] * first[k] - ramp(n * n)).norm() < 1e-11 * ramp(n * n).norm());
    CHECK(solved(matrices[k]) == first[k]);
  }
}

TEST_CASE("one object goes from pattern to pattern and back, and past a matrix that is not positive") {
  const SparseMatrix A = springs(40, 0.1, 700), B = springs(40, 0.1, 900), indefinite = springs(40, -0.5, 700);
  const Eigen::VectorXd of_a = solved(A), of_b = solved(B);
  SparseCholesky factor;
  for (int turn = 0; turn < 2; ++turn) {
    REQUIRE(factor.factor(A));
    CHECK(factor.solve(ramp(A.rows())) == of_a);
    CHECK(!factor.factor(indefinite));
    REQUIRE(factor.factor(B));
    CHECK(factor.solve(ramp(A.rows())) == of_b);
  }
  CHECK(!SparseCholesky().factor(indefinite));
  CHECK(solved(A) == of_a);
}

}  // namespace sparse_cholesky_tests
