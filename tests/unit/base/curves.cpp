// Curves through points, and in formulas.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/curves.h"
#include "base/error.h"
#include "base/expression.h"

namespace curves_tests {
using namespace seiche;

namespace {

TimeCurve through(std::vector<double> times, std::vector<double> values, CurveForm interpolation) {
  TimeCurve curve{std::move(times), std::move(values), interpolation};
  curve.set_slopes();
  return curve;
}

}  // namespace

TEST_CASE("curves pass through their points and are constant beyond") {
  for (const CurveForm kind : {CurveForm::smooth, CurveForm::linear}) {
    const TimeCurve curve = through({1, 2, 4}, {3, -1, 5}, kind);
    CHECK(curve(0) == 3);
    CHECK(curve(1) == 3);
    CHECK(curve(2) == -1);
    CHECK(curve(4) == 5);
    CHECK(curve(9) == 5);
    CHECK(through({7}, {2}, kind)(1) == 2);
  }
  CHECK(through({0, 2}, {0, 4}, CurveForm::linear)(0.5) == 1);
}

TEST_CASE("smooth curves do not overshoot, and their slope is continuous") {
  const TimeCurve curve = through({0, 1, 1.1, 2, 3}, {0, 0, 1, 1, 0.5}, CurveForm::smooth);
  double steepest = 0, jump = 0, last = 0;
  constexpr double dt = 1e-4;
  for (double t = 0; t < 3; t += dt) {
    CHECK(curve(t) >= 0);
    CHECK(curve(t) <= 1);
    const double slope = (curve(t + dt) - curve(t)) / dt;
    if (t > 0) jump = std::max(jump, std::abs(slope - last));
    steepest = std::max(steepest, std::abs(slope));
    last = slope;
  }
  CHECK(jump < 0.06 * steepest);  // the second derivative of the steep piece, 6 / 0.1^2, times dt: 0.06 of 15
}

// Fourth order would be that of exact slopes; the harmonic mean's are of second order: error h^3 and less.
TEST_CASE("smooth curves come near a function between its points") {
  const auto worst = [](int n) {
    std::vector<double> t, v;
    for (int k = 0; k <= n; ++k) t.push_back(1.2 * k / n), v.push_back(std::exp(t.back()));
    const TimeCurve curve = through(t, v, CurveForm::smooth);
    double most = 0;
    for (double x = 0.3; x < 0.9; x += 0.001) most = std::max(most, std::abs(curve(x) - std::exp(x)));
    return most;
  };
  CHECK(std::log2(worst(12) / worst(24)) > 2.7);
}

TEST_CASE("formulas use declared curves, and keep those that they were parsed with") {
  declare_curves({{"lift", {{0, 1}, {0, 2}, CurveForm::linear}}});
  const Expression formula("1 + 2*lift(t/2)");
  CHECK(formula({0, 0, 0}, 1) == 3);
  CHECK_FALSE(formula.is_constant());
  declare_curves({});
  CHECK(formula({0, 0, 0}, 2) == 5);
  CHECK_THROWS_AS(Expression("lift(t)"), Error);
}

}  // namespace curves_tests
