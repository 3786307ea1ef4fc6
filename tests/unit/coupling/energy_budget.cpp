// Bound on the kinetic energy at the end of a step, against closed-form motions.
#include "coupling/report/energy_budget.h"

#include <catch2/catch.hpp>

namespace energy_budget_tests {
using namespace seiche;

namespace {

constexpr double margin2 = speed_margin * speed_margin;

// Energy over the bound without its margin: at most 1 for a possible motion.
double used(double energy, const EnergyBudget& budget) {
  return margin2 * energy / most_kinetic_energy(budget);
}

}  // namespace

TEST_CASE("without energy, forces or anything given nothing may move") {
  EnergyBudget b;
  b.mass = 3;
  CHECK(most_kinetic_energy(b) == 0);
}

TEST_CASE("free fall from rest and in flight uses up the budget of gravity") {
  EnergyBudget b;
  b.mass = 3;
  b.gain = 9.81 * 0.1;
  CHECK(used(0.5 * 3 * std::pow(0.981, 2), b) == Approx(1));
  b.kinetic = 0.5 * 3 * 4;
  CHECK(used(0.5 * 3 * std::pow(2 + 0.981, 2), b) == Approx(1));
}

TEST_CASE("a stretched spring and a surface may let go all that they store, and no more") {
  EnergyBudget b;
  b.mass = 2;
  b.elastic = 5;
  b.surface = 3;
  CHECK(used(8, b) == Approx(1));
}

// A piston of area A that starts impulsively: p = rho L U/dt, dt p.b = rho L A U^2, twice the energy that the column
// gains.
TEST_CASE("a piston that starts at once pays for what it pushes by pressure") {
  const double rho = 1000, length = 2, area = 0.5, speed = 3, dt = 1e-3;
  EnergyBudget b;
  b.mass = rho * length * area;
  b.pushed = dt * (rho * length * speed / dt) * area * speed;
  CHECK(used(0.5 * b.mass * speed * speed, b) == Approx(1));
}

TEST_CASE("forces on a body add |M^-1 f| dt to |v|") {
  EnergyBudget b;
  b.mass = 2;
  b.momentum = 7 / std::sqrt(2.0) * 0.1;
  CHECK(used(0.5 * 2 * std::pow(7.0 / 2 * 0.1, 2), b) == Approx(1));
}

TEST_CASE("a thousand times the velocity is beyond every budget of a step") {
  EnergyBudget b;
  b.kinetic = 10;
  b.mass = 20;
  b.gain = b.given = 1;
  CHECK(1e6 * b.kinetic > most_kinetic_energy(b));
}

}  // namespace energy_budget_tests
