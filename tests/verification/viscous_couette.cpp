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
  for (int k = 0; k < 2; ++k)
    WARN(k << " viscous " << loads[k].torque[2] / torque << " pressure " << p.pressure_torque(k, center)[2] / torque);
  return {p.error(exact), std::abs(loads[0].torque[2] + torque) / torque};
}

}  // namespace

TEST_CASE("couette cylinders", "[viscous]") {
  const int turns = GENERATE(0, 1, 3);
  double last = 0;
  for (int n : {32, 64}) {
    const CouetteErrors e = couette(n, turns);
    WARN(n << ": L2 " << e.velocity << ", order " << std::log2(last / e.velocity) << ", torque " << e.torque);
    last = e.velocity;
  }
}

namespace {

// Channels at an angle in a periodic box of p by q, k cells a unit: walls at |s| = half of the distance s across.
struct Incline {
  int k, p, q;
  double norm = std::hypot(p, q), period = p * q / norm, half = 0.31 * period;
  Vec<2> along = Vec<2>(p, q) / norm;

  double across(const Vec<2>& x) const {
    const double s = (p * x[1] - q * x[0]) / norm - 0.0123;
    return s - period * std::rint(s / period);
  }
  ViscousProblem<2> problem(std::function<double(const Vec<2>&)> phi) const {
    SolidSpec wall = viscous_solid("expression");
    const std::string s = fmt::format("(({}*y-{}*x)/{:.17g}-0.0123)", p, q, norm);
    wall.shape.phi = fmt::format("{2:.17g}-abs({0}-{1:.17g}*rint({0}/{1:.17g}))", s, period, half);
    typename ViscousProblem<2>::Settings settings;
    settings.cells = p * k, settings.size = p, settings.sides = SideType::periodic, settings.dt = 1e6;
    settings.solids = {wall}, settings.phi = phi;
    return ViscousProblem<2>(settings, [&](Scene& scene) {
      scene.domain.cells[1] = q * k;
      scene.domain.upper[1] = q;
      scene.domain.cell_size = 1.0 / k;
    });
  }
};

// Relative L2 error of a stream under an acceleration of 2 m/s^2 (nu = 1).
double poiseuille(const Incline& c, int turns) {
  ViscousProblem<2> p = c.problem([](const Vec<2>&) { return -1.0; });
  p.set(p.u_star, [&](int a, const Vec<2>&) { return 1e6 * 2 * c.along[a]; });
  p.solve_with_flux(turns);
  REQUIRE(p.solved);
  const auto exact = [&](int a, const Vec<2>& x) { return (c.half * c.half - std::pow(c.across(x), 2)) * c.along[a]; };
  return p.error(exact) / (c.half * c.half);
}

// The same of a film with a free surface: no shear there.
double film(const Incline& c, int turns) {
  const double top = 0.31 * c.half, depth = top + c.half;
  ViscousProblem<2> p = c.problem([&](const Vec<2>& x) { return c.across(x) - top; });
  p.set(p.u_star, [&](int a, const Vec<2>&) { return 1e6 * 2 * c.along[a]; });
  p.solve_with_flux(turns);
  REQUIRE(p.solved);
  const auto exact = [&](int a, const Vec<2>& x) {
    const double d = std::min(c.across(x) + c.half, depth);
    return d * (2 * depth - d) * c.along[a];
  };
  return p.error(exact) / (depth * depth);
}

}  // namespace

TEST_CASE("inclined poiseuille", "[viscous]") {
  const int turns = GENERATE(0, 1);
  double last = 0;
  for (int k : {16, 32, 64}) {
    const double e = poiseuille({k, 1, 1}, turns), f = film({k, 1, 1}, turns);
    WARN("45 " << k << ": L2 " << e << ", order " << std::log2(last / e) << " film " << f);
    last = e;
  }
  for (int k : {3, 6, 12}) {
    const double e = poiseuille({k, 11, 4}, turns), f = film({k, 11, 4}, turns);
    WARN("20 " << k << ": L2 " << e << ", order " << std::log2(last / e) << " film " << f);
    last = e;
  }
}

namespace {

// A ball that turns within a ball at rest: u = omega x r (a + b/r^3), torque 8 pi mu b.
CouetteErrors spherical_couette(int n, int turns) {
  constexpr double inner = 0.2, outer = 0.45, cube_in = inner * inner * inner, cube_out = outer * outer * outer;
  constexpr double b = 1 / (1 / cube_in - 1 / cube_out), a = -b / cube_out;
  const Vec3 center(0.5031, 0.4983, 0.5017), spin = Vec3(1, -2, 2) / 3;
  ViscousProblem<3> p({.cells = n,
                       .size = 1,
                       .sides = SideType::no_slip,
                       .dt = 1e6,
                       .solids = {viscous_ball(center, inner), viscous_ball(center, outer, true)}});
  p.move(0, {Vec3::Zero(), spin, center});
  p.solve_with_flux(turns);
  REQUIRE(p.solved);
  const auto exact = [&](int axis, const Vec3& x) {
    const Vec3 r = x - center;
    return (a + b / std::pow(r.norm(), 3)) * spin.cross(r)[axis];
  };
  const auto loads = viscous_forces(p.input(), p.system, p.u, Eigen::VectorXd(), {center, center});
  const double torque = 8 * pi * b;
  for (int k = 0; k < 2; ++k)
    WARN(k << " viscous " << loads[k].torque.dot(spin) / torque << " pressure "
           << p.pressure_torque(k, center).dot(spin) / torque);
  return {p.error(exact), (loads[0].torque + torque * spin).norm() / torque};
}

}  // namespace

TEST_CASE("spherical couette", "[viscous]") {
  for (int turns : {0, 1}) {
    double last = 0;
    for (int n : {10, 20}) {
      const CouetteErrors e = spherical_couette(n, turns);
      WARN(n << " turns " << turns << ": L2 " << e.velocity << ", order " << std::log2(last / e.velocity) << ", torque "
             << e.torque);
      last = e.velocity;
    }
  }
}
