// Every material of the table: derivatives against differences, objectivity, rest state, small-strain limit.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "base/error.h"
#include "linalg/core/symmetric_eigen.h"
#include "solid/material/material.h"

namespace elastic_materials_tests {
using namespace seiche;

namespace {

constexpr double stiffness_unit = 1e5;  // Young's modulus, Pa; results are relative to it
const Lame material = lame_of(stiffness_unit, 0.4);

template <int Dim>
Gradient<Dim> random_matrix(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> entry(-size, size);
  return Gradient<Dim>::NullaryExpr([&] { return entry(random); });
}

template <int Dim>
Gradient<Dim> random_rotation(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-3, 3);
  if constexpr (Dim == 2) {
    return Eigen::Rotation2Dd(angle(random)).toRotationMatrix();
  } else {
    const Eigen::Quaterniond q(angle(random), angle(random), angle(random), angle(random));
    return q.normalized().toRotationMatrix();
  }
}

// A rotation times a strain with entries up to 0.3; det F > 0.
template <int Dim>
Gradient<Dim> random_state(std::mt19937& random) {
  while (true) {
    const Gradient<Dim> F =
        random_rotation<Dim>(random) * (Gradient<Dim>::Identity() + random_matrix<Dim>(random, 0.3));
    if (F.determinant() > 0.2) return F;
  }
}

// Central differences of step 1e-5: truncation about 1e-10, cancellation about 1e-16 / 1e-5 = 1e-11, relative.
constexpr double difference_step = 1e-5, difference_error = 1e-7;

template <int Dim>
void check_derivatives(const ElasticMaterial<Dim>& row, const Gradient<Dim>& F) {
  const Gradient<Dim> P = row.stress(material, F);
  const Hessian<Dim> H = row.stiffness(material, F);
  double stress_error = 0, stiffness_error = 0;
  for (int k = 0; k < Dim * Dim; ++k) {
    Gradient<Dim> step = Gradient<Dim>::Zero();
    step(k % Dim, k / Dim) = difference_step;
    const double slope = (row.energy(material, F + step) - row.energy(material, F - step)) / (2 * difference_step);
    const Gradient<Dim> bend =
        (row.stress(material, F + step) - row.stress(material, F - step)) / (2 * difference_step);
    stress_error = std::max(stress_error, std::abs(slope - P(k % Dim, k / Dim)));
    const Eigen::Map<const Eigen::VectorXd> column(bend.data(), Dim * Dim);
    stiffness_error = std::max(stiffness_error, (column - H.col(k)).norm());
  }
  INFO(row.name << ", F =\n" << F);
  CHECK(stress_error < difference_error * stiffness_unit);
  CHECK(stiffness_error < difference_error * H.norm());
  CHECK((H - H.transpose()).norm() < 1e-14 * H.norm());
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Stress and stiffness are the derivatives of the energy", "[elastic]", ((int Dim), Dim), 2, 3) {
  std::mt19937 random(1);
  for (const auto& row : elastic_materials<Dim>()) {
    for (int i = 0; i < 20; ++i) check_derivatives<Dim>(row, random_state<Dim>(random));
    check_derivatives<Dim>(row, Gradient<Dim>::Identity());
  }
}

TEMPLATE_TEST_CASE_SIG("Materials do not see rotations", "[elastic]", ((int Dim), Dim), 2, 3) {
  std::mt19937 random(2);
  for (const auto& row : elastic_materials<Dim>()) {
    INFO(row.name);
    for (int i = 0; i < 20; ++i) {
      const Gradient<Dim> F = random_state<Dim>(random), R = random_rotation<Dim>(random);
      const double Psi = row.energy(material, F);
      CHECK(std::abs(row.energy(material, R * F) - Psi) < 1e-12 * (stiffness_unit + Psi));
      CHECK((row.stress(material, R * F) - R * row.stress(material, F)).norm() < 1e-11 * stiffness_unit);
      CHECK(Psi > 0);
      CHECK(std::abs(row.energy(material, R)) < 1e-14 * stiffness_unit);  // round-off of entries about 1
      CHECK(row.stress(material, R).norm() < 1e-13 * stiffness_unit);
    }
  }
}

// At F = 1 the stiffness is that of linear elasticity: 2 mu sym(dF) + lambda tr(dF).
TEMPLATE_TEST_CASE_SIG("Materials agree with linear elasticity at small strain", "[elastic]", ((int Dim), Dim), 2, 3) {
  std::mt19937 random(3);
  for (const auto& row : elastic_materials<Dim>()) {
    INFO(row.name);
    const Hessian<Dim> H = row.stiffness(material, Gradient<Dim>::Identity());
    const Gradient<Dim> dF = random_matrix<Dim>(random, 1);
    const Gradient<Dim> linear =
        material.mu * (dF + dF.transpose()) + material.lambda * dF.trace() * Gradient<Dim>::Identity();
    const Eigen::Map<const Eigen::VectorXd> step(dF.data(), Dim * Dim), expected(linear.data(), Dim * Dim);
    CHECK((H * step - expected).norm() < 1e-14 * H.norm() * step.norm());
  }
}

TEMPLATE_TEST_CASE_SIG("The projected stiffness has no negative eigenvalue", "[elastic]", ((int Dim), Dim), 2, 3) {
  std::mt19937 random(4);
  int indefinite = 0;
  for (const auto& row : elastic_materials<Dim>()) {
    INFO(row.name);
    for (int i = 0; i < 50; ++i) {
      const Gradient<Dim> F = 0.6 * random_state<Dim>(random);  // compressed: often indefinite
      const Hessian<Dim> H = row.stiffness(material, F), projected = project_positive<Dim>(H);
      const double least = symmetric_eigenvalues(projected)[0];
      CHECK(least > -1e-14 * H.norm());
      const bool positive = symmetric_eigenvalues(H)[0] >= 0;
      if (positive) CHECK(projected == H);
      indefinite += !positive;
    }
  }
  CHECK(indefinite > 50);
}

TEST_CASE("Wrong elastic constants are refused", "[elastic]") {
  CHECK_THROWS_AS(lame_of(0, 0.3), Error);
  CHECK_THROWS_AS(lame_of(1, 0.5), Error);
  CHECK_THROWS_AS(lame_of(1, -0.1), Error);
  CHECK_THROWS_WITH(elastic_material<2>("jelly"), Catch::Matchers::Contains("stable_neo_hookean, neo_hookean"));
}

}  // namespace elastic_materials_tests
