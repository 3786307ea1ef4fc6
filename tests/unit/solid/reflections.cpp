// Impacts of many pairs at once.
#include "solid/contact/reflections.h"

#include <catch2/catch.hpp>
#include <random>

namespace reflections_tests {
using namespace seiche;

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Pairs of neighbours in a row of balls of 1 kg that move along it: part at v_{n+1} - v_n.
Matrix row_of(int balls) {
  Matrix W = Matrix::Zero(balls - 1, balls);
  for (int n = 0; n + 1 < balls; ++n) W(n, n) = -1, W(n, n + 1) = 1;
  return W;
}

// Velocities after the impact.
Vector after(const Matrix& W, const Vector& v, double e) {
  const Vector l = rebound_impulses(W * W.transpose(), W * v, Vector::Constant(W.rows(), e));
  return v + W.transpose() * l;
}

}  // namespace

TEST_CASE("in a cradle the last ball leaves with the speed of the first") {
  for (const int balls : {2, 3, 5, 12}) {
    const Vector out = after(row_of(balls), Vector::Unit(balls, 0), 1);
    CHECK((out - Vector::Unit(balls, balls - 1)).norm() < 1e-12);
  }
  // two come, two leave
  Vector in = Vector::Zero(5), out = Vector::Zero(5);
  in.head(2).setOnes(), out.tail(2).setOnes();
  CHECK((after(row_of(5), in, 1) - out).norm() < 1e-12);
}

TEST_CASE("a pair rebounds with its coefficient, and the middle of three keeps still between two equal ones") {
  for (const double e : {0.0, 0.4, 1.0}) {
    Vector pair(2), three(3);
    pair << 1, 0;
    three << 1, 0, -1;
    const Vector two = after(row_of(2), pair, e), all = after(row_of(3), three, e);
    CHECK(two[1] - two[0] == Approx(e).margin(1e-12));
    CHECK(two.sum() == Approx(1));
    CHECK(all[1] == Approx(0).margin(1e-9));
    CHECK(all[2] == Approx(e).margin(1e-9));
  }
}

// Each pair has a coefficient of its own. More than 8 depend on each other, and sweeps over them converge slowly: up to
// 0.004 m/s of approach were left of 2 to 3.
TEST_CASE("rebounds gain no energy, and no pair approaches after them") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (int n = 0; n < 200; ++n) {
    const int pairs = 1 + n % 12;
    const Matrix W = Matrix::NullaryExpr(pairs, 8, [&] { return draw(random); }), A = W * W.transpose();
    const Vector v = Vector::NullaryExpr(8, [&] { return draw(random); }), w = W * v;
    const Vector e = Vector::NullaryExpr(pairs, [&] { return std::abs(draw(random)); });
    const Vector l = rebound_impulses(A, w, e), stopped = stopping_impulses(A, w);
    const double left = pairs > 8 ? 1e-2 : 1e-6;
    CAPTURE(n, pairs);
    CHECK(l.minCoeff() >= 0);
    CHECK((w + A * l).minCoeff() > -left);
    CHECK((v + W.transpose() * l).squaredNorm() <= (1 + 1e-9) * v.squaredNorm());
    CHECK((w + A * stopped).minCoeff() > -left);
    CHECK(stopped.minCoeff() >= 0);
  }
}

TEST_CASE("a share of impulses keeps within the energy") {
  CHECK(share_within(0, 2, 1) == Approx(1));
  CHECK(share_within(1, 2, 0) == 0);
  CHECK(share_within(-1, 2, 0) == Approx(1));
  CHECK(share_within(-1, 2, -10) == Approx(0.5));  // the least energy there is
  CHECK(share_within(1, 2, 2) == Approx(1));
  CHECK(share_within(1, 0, 2) == 0);
}

}  // namespace reflections_tests
