// Stokes flow between cylinders, and between inclined plates, against exact solutions.
#include <catch2/catch.hpp>

#include "viscous_problem.h"

using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double pi = 3.14159265358979323846;

struct CouetteErrors {
  double velocity, torque;
};

// The inner cylinder turns with 1 rad/s, the outer one rests: u = A r + B/r.
CouetteErrors couette(int n, int turns) {
  constexpr double inner = 0.25, outer = 0.5, A = -1.0 / 3, B = 1.0 / 12, size = 1.1;
  const Vec3 center(size / 2 + 0.0031, size / 2 - 0.0017, 0);
  ViscousProblem<2> p({.cells = n,
                       .size = size,
                       .sides = SideType::no_slip,
                       .dt = 1e6,
                       .solids = {viscous_ball(center, inner), viscous_ball(center, outer, true)}});
  p.move(0, {Vec3::Zero(), Vec3::UnitZ(), center});
  const double change = p.solve_with_flux(turns);
  if (turns) WARN("change " << change);
  REQUIRE(p.solved);
  const auto exact = [&](int a, const Vec<2>& x) {
    const Vec<2> r = x - center.head<2>();
    const double turn = A + B / r.squaredNorm();
    return a == 0 ? -turn * r[1] : turn * r[0];
  };
  const auto loads = viscous_forces(p.input(), p.system, p.u, Eigen::VectorXd(), {center, center});
  const double torque = 4 * pi * B;
  return {p.error(exact), std::abs(loads[0].torque[2] + torque) / torque};
}

}  // namespace

TEST_CASE("couette cylinders", "[viscous]") {
  const int turns = GENERATE(0, 1, 2, 8);
  double last = 0;
  for (int n : {32, 64}) {
    const CouetteErrors e = couette(n, turns);
    WARN(n << ": L2 " << e.velocity << ", order " << std::log2(last / e.velocity) << ", torque " << e.torque);
    last = e.velocity;
  }
}
