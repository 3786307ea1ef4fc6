// Constraints on the unknowns of bodies, by their multipliers.
#include <catch2/catch.hpp>

#include <random>

#include <Eigen/Dense>

#include "linalg/core/body_matrix.h"

namespace constraint_rows_tests {
using namespace seiche;

namespace {

constexpr int unknowns = 24, rows = 7, dependent = 3;

struct Case {
  SparseMatrix H, C;
  Eigen::VectorXd r, b;
};

Eigen::MatrixXd random_matrix(int n, int m, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(n, m, [&] { return uniform(random); });
}

// Bodies of six unknowns each, of very different masses. The last rows are sums of the others.
Case make_case(double lightest) {
  std::mt19937 random(5);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(unknowns, unknowns), C(rows + dependent, unknowns);
  for (int k = 0; k < unknowns; k += 6) {
    const Eigen::MatrixXd R = random_matrix(6, 6, random);
    H.block(k, k, 6, 6) = (k == 6 ? lightest : 1) * (R * R.transpose() + Eigen::MatrixXd::Identity(6, 6));
  }
  C.topRows(rows) = random_matrix(rows, unknowns, random);
  const Eigen::MatrixXd sums = random_matrix(dependent, rows, random);
  C.bottomRows(dependent) = sums * C.topRows(rows);
  Eigen::VectorXd b(rows + dependent);
  b.head(rows) = random_matrix(rows, 1, random);
  b.tail(dependent) = sums * b.head(rows);
  return {H.sparseView(), C.sparseView(), random_matrix(unknowns, 1, random), b};
}

// [H C'; C 0] (v, y) = (r, b) with the independent rows alone.
Eigen::VectorXd solved_densely(const Case& c) {
  const Eigen::MatrixXd C = Eigen::MatrixXd(c.C).topRows(rows);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(unknowns + rows, unknowns + rows);
  K.topLeftCorner(unknowns, unknowns) = c.H;
  K.topRightCorner(unknowns, rows) = C.transpose();
  K.bottomLeftCorner(rows, unknowns) = C;
  Eigen::VectorXd right(unknowns + rows);
  right << c.r, c.b.head(rows);
  return K.fullPivLu().solve(right).head(unknowns);
}

}  // namespace

TEST_CASE("velocities on constraints are those of the bordered matrix, dependent rows or not", "[body matrix]") {
  for (const double lightest : {1.0, 1e-6}) {
    const Case c = make_case(lightest);
    BodyMatrix H{Communicator()};
    REQUIRE(H.set(c.H, c.C));
    const Eigen::VectorXd v = H.solve(c.r) + H.prescribed(c.b), exact = solved_densely(c);
    CAPTURE(lightest);
    CHECK(H.constraints().independent().size() == rows);
    CHECK((v - exact).norm() <= 1e-9 * exact.norm());  // 3e-15 and 1e-11: the light body's unknowns are large
    CHECK((c.C * v - c.b).norm() <= 1e-9 * c.b.norm());
    CHECK((H.solve_columns(c.r) - H.solve(c.r)).norm() <= 1e-12 * H.solve(c.r).norm());
  }
}

TEST_CASE("loads without multipliers are the transpose of motions on the constraints", "[body matrix]") {
  const Case c = make_case(1);
  BodyMatrix H{Communicator()};
  REQUIRE(H.set(c.H, c.C));
  std::mt19937 random(9);
  const Eigen::VectorXd y = random_matrix(unknowns, 1, random), f = random_matrix(unknowns, 1, random);
  const ConstraintRows& constraints = H.constraints();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(rows + dependent);
  CHECK(constraints.moved_onto(y, none).dot(f) == Approx(y.dot(constraints.without_multipliers(f))).epsilon(1e-12));
  // Loads C'y of the multipliers alone vanish.
  const Eigen::VectorXd multipliers = random_matrix(rows + dependent, 1, random);
  CHECK(constraints.without_multipliers(c.C.transpose() * multipliers).norm() <= 1e-12);
  const Eigen::VectorXd found = H.multipliers_against(c.C.transpose() * multipliers);
  CHECK((c.C.transpose() * (found + multipliers)).norm() <= 1e-12);
}

// A chain of bodies, closed by one joint more and with the rows of every third joint twice: W is sparse.
TEST_CASE("a long chain of bodies moves on its constraints", "[body matrix]") {
  constexpr int bodies = 60, held = 5;
  std::mt19937 random(3);
  std::vector<Eigen::Triplet<double>> mass, rows;
  for (int k = 0; k < bodies; ++k) {
    const Eigen::MatrixXd R = random_matrix(6, 6, random);
    const Eigen::MatrixXd M = std::pow(10, k % 4) * (R * R.transpose() + Eigen::MatrixXd::Identity(6, 6));
    for (int i = 0; i < 36; ++i) mass.emplace_back(6 * k + i / 6, 6 * k + i % 6, M(i / 6, i % 6));
  }
  int count = 0;
  const auto join = [&](int a, int b, int copies) {
    const Eigen::MatrixXd first = random_matrix(held, 6, random), second = random_matrix(held, 6, random);
    for (int copy = 0; copy < copies; ++copy, count += held)
      for (int i = 0; i < held; ++i)
        for (int k = 0; k < 6; ++k) {
          rows.emplace_back(count + i, 6 * a + k, first(i, k));
          rows.emplace_back(count + i, 6 * b + k, second(i, k));
        }
  };
  for (int k = 0; k + 1 < bodies; ++k) join(k, k + 1, k % 3 == 0 ? 2 : 1);
  join(0, bodies - 1, 1);
  SparseMatrix M(6 * bodies, 6 * bodies), C(count, 6 * bodies);
  M.setFromTriplets(mass.begin(), mass.end());
  C.setFromTriplets(rows.begin(), rows.end());
  BodyMatrix H{Communicator()};
  REQUIRE(H.set(M, C));
  CHECK(H.constraints().independent().size() == held * bodies);
  const Eigen::VectorXd r = random_matrix(6 * bodies, 1, random), b = C * random_matrix(6 * bodies, 1, random);
  const Eigen::VectorXd v = H.solve(r) + H.prescribed(b), y = H.multipliers_against(M * v - r);
  CHECK((C * v - b).norm() <= 1e-11 * b.norm());
  CHECK((M * v - r + C.transpose() * y).norm() <= 1e-10 * (M * v - r).norm());
}

}  // namespace constraint_rows_tests
