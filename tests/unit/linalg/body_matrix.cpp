#include <catch2/catch.hpp>

#include <random>

#include "linalg/core/body_matrix.h"

namespace body_matrix_tests {
using namespace seiche;

namespace {

// A connected part of n rows in a poor order for elimination: a ring through rows in steps of a stride.
void add_ring(int first, int n, std::vector<Eigen::Triplet<double>>& entries) {
  const int stride = 7;  // coprime to the n below
  for (int k = 0; k < n; ++k) {
    const int i = first + k * stride % n, j = first + (k + 1) * stride % n;
    entries.emplace_back(i, i, 4 + k % 3);
    entries.emplace_back(i, j, -1.5);
    entries.emplace_back(j, i, -1.5);
  }
}

// Rings side by side.
SparseMatrix rings(const std::vector<int>& sizes) {
  std::vector<Eigen::Triplet<double>> entries;
  int first = 0;
  for (const int n : sizes) {
    add_ring(first, n, entries);
    first += n;
  }
  SparseMatrix H(first, first);
  H.setFromTriplets(entries.begin(), entries.end());
  return H;
}

}  // namespace

TEST_CASE("the matrix behind bodies is solved with, whatever parts it has", "[body matrix]") {
  constexpr int large = BodyMatrix::shared_limit + 3;
  for (const std::vector<int>& sizes : std::vector<std::vector<int>>{
           {40}, {40, 12, 60}, {large}, {large, 40}, {40, large, 60}, {large, 12, large + 2, 40}}) {
    const Communicator ranks;
    BodyMatrix matrix(ranks);
    const SparseMatrix H = rings(sizes);
    REQUIRE(matrix.set(H));
    std::mt19937 random(3);
    Eigen::VectorXd b(H.rows());
    for (double& x : b) x = std::uniform_real_distribution<double>(-1, 1)(random);
    const double residual = (b - H * matrix.solve(b)).norm() / b.norm();
    CAPTURE(sizes, residual);
    CHECK(residual <= 1e-13);  // the condition is below 10
    Eigen::MatrixXd B(H.rows(), 3);
    B << b, 2 * b, b.reverse();
    CHECK((B - H * matrix.solve_columns(B)).norm() <= 1e-13 * B.norm());
  }
}

TEST_CASE("a matrix behind bodies that is not positive definite is said to be", "[body matrix]") {
  const Communicator ranks;
  BodyMatrix matrix(ranks);
  for (const std::vector<int>& sizes : std::vector<std::vector<int>>{{40, 12}, {BodyMatrix::shared_limit + 3, 40}}) {
    SparseMatrix H = rings(sizes);
    CHECK(matrix.set(H));
    H.coeffRef(H.rows() - 1, H.rows() - 1) = -1;
    CHECK_FALSE(matrix.set(H));
  }
}

}  // namespace body_matrix_tests
