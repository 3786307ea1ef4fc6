// Stokes flow between cylinders, and between inclined plates, against exact solutions.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "viscous_case.h"

namespace viscous_couette_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double pi = 3.14159265358979323846;

struct CouetteErrors {
  double velocity, torque;
};

// The inner cylinder rotates at 1 rad/s, the outer one is at rest: u = A r + B/r.
CouetteErrors couette(int n, int turns) {
  constexpr double inner = 0.25, outer = 0.5, A = -1.0 / 3, B = 1.0 / 12, size = 1.1;
  const Vec3 center(size / 2 + 0.0031, size / 2 - 0.0017, 0);
  ViscousCase<2> p({.cells = n,
                    .size = size,
                    .sides = SideType::no_slip,
                    .dt = 1e6,
                    .solids = {viscous_ball(center, inner), viscous_ball(center, outer, true)}});
  p.move(0, {Vec3::Zero(), Vec3::UnitZ(), center});
  p.solve_with_flux(turns);
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

// Without the fluxes of cut faces the order is 1.2 to 1.4; one iteration with them gives 2.
TEST_CASE("couette cylinders", "[viscous][long]") {
  const CouetteErrors coarse = couette(32, 1), fine = couette(64, 1), plain = couette(64, 0);
  CAPTURE(coarse.velocity, fine.velocity, plain.velocity, coarse.torque, fine.torque);
  CHECK(coarse.velocity <= 5.5e-4);
  CHECK(fine.velocity <= 1.3e-4);
  CHECK(order(coarse.velocity, fine.velocity) >= 1.9);
  CHECK(plain.velocity >= 3 * fine.velocity);
  CHECK(fine.torque <= 2e-3);
}

namespace {

// Inclined channels in a periodic box of p by q with k cells per unit. Walls lie at |s| = half, s the distance across.
struct Incline {
  int k, p, q;
  double norm = std::hypot(p, q), period = p * q / norm, half = 0.31 * period;
  Vec<2> along = Vec<2>(p, q) / norm;

  double across(const Vec<2>& x) const {
    const double s = (p * x[1] - q * x[0]) / norm - 0.0123;
    return s - period * std::rint(s / period);
  }
  ViscousCase<2> problem(std::function<double(const Vec<2>&)> phi) const {
    SolidSpec wall = viscous_solid("expression");
    const std::string s = fmt::format("(({}*y-{}*x)/{:.17g}-0.0123)", p, q, norm);
    wall.shape.phi = fmt::format("{2:.17g}-abs({0}-{1:.17g}*rint({0}/{1:.17g}))", s, period, half);
    typename ViscousCase<2>::Settings settings;
    settings.cells = p * k, settings.size = p, settings.sides = SideType::periodic, settings.dt = 1e6;
    settings.solids = {wall}, settings.phi = phi;
    return ViscousCase<2>(settings, [&](Scene& scene) {
      scene.domain.cells[1] = q * k;
      scene.domain.upper[1] = q;
      scene.domain.cell_size = 1.0 / k;
    });
  }
};

// Relative L2 error of the flow under an acceleration of 2 m/s^2 (nu = 1).
double poiseuille(const Incline& c, int turns) {
  ViscousCase<2> p = c.problem([](const Vec<2>&) { return -1.0; });
  p.set(p.u_star, [&](int a, const Vec<2>&) { return 1e6 * 2 * c.along[a]; });
  p.solve_with_flux(turns);
  REQUIRE(p.solved);
  const auto exact = [&](int a, const Vec<2>& x) { return (c.half * c.half - std::pow(c.across(x), 2)) * c.along[a]; };
  return p.error(exact) / (c.half * c.half);
}

// The same for a film with a free surface, where the shear is zero.
double gap_flow(const Incline& c, int turns) {
  const double top = 0.31 * c.half, depth = top + c.half;
  ViscousCase<2> p = c.problem([&](const Vec<2>& x) { return c.across(x) - top; });
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

// At 45 degrees errors depend on the position of the walls between nodes, so the order is taken over two halvings.
TEST_CASE("inclined channels and films", "[viscous][long]") {
  const Incline coarse{3, 11, 4}, middle{6, 11, 4}, fine{12, 11, 4};
  CHECK(order(poiseuille(coarse, 1), poiseuille(middle, 1)) >= 1.9);
  CHECK(order(poiseuille(middle, 1), poiseuille(fine, 1)) >= 1.9);
  CHECK(order(gap_flow(middle, 1), gap_flow(fine, 1)) >= 1.9);
  CHECK(gap_flow(fine, 1) <= 4e-4);
  CHECK(order(poiseuille({16, 1, 1}, 1), poiseuille({64, 1, 1}, 1)) >= 2 * 1.85);
  CHECK(gap_flow({64, 1, 1}, 1) <= 2e-4);
}

// The iteration over fluxes of cut faces converges: two more solves reduce the change to 1 %.
TEST_CASE("no-slip fluxes settle", "[viscous]") {
  const Incline c{6, 11, 4};
  ViscousCase<2> p = c.problem([](const Vec<2>&) { return -1.0; });
  p.set(p.u_star, [&](int a, const Vec<2>&) { return 1e6 * 2 * c.along[a]; });
  const double first = p.solve_with_flux(1), third = p.solve_with_flux(3);
  CAPTURE(first, third);
  CHECK(third <= 1e-2 * first);
}

namespace {

// A ball rotating within a ball at rest: u = omega x r (a + b/r^3), torque 8 pi mu b.
CouetteErrors spherical_couette(int n, int turns) {
  constexpr double inner = 0.2, outer = 0.45, cube_in = inner * inner * inner, cube_out = outer * outer * outer;
  constexpr double b = 1 / (1 / cube_in - 1 / cube_out), a = -b / cube_out;
  const Vec3 center(0.5031, 0.4983, 0.5017), spin = Vec3(1, -2, 2) / 3;
  ViscousCase<3> p({.cells = n,
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
  return {p.error(exact), (loads[0].torque + torque * spin).norm() / torque};
}

}  // namespace

TEST_CASE("spherical couette", "[viscous][long]") {
  const CouetteErrors coarse = spherical_couette(10, 1), fine = spherical_couette(16, 1);
  CAPTURE(coarse.velocity, fine.velocity, coarse.torque, fine.torque);
  CHECK(order(coarse.velocity, fine.velocity) >= 1.9 * std::log2(1.6));
  CHECK(order(coarse.torque, fine.torque) >= 1.9 * std::log2(1.6));
  CHECK(fine.torque <= 0.04);
}

namespace {

// Shear above a tilted plane, u = t psi: the flux through a cut face is known.
template <int Dim>
void check_flux(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  SolidSpec plane = viscous_solid("expression");
  plane.shape.phi = Dim == 2 ? "0.6*x+0.8*y-0.4217" : "0.48*x+0.6*y+0.64*z-0.8217";
  s.solids = {plane};
  ViscousCase<Dim> p(s);
  p.assemble();
  const Vec<Dim> normal = Dim == 2 ? Vec3(0.6, 0.8, 0).head<Dim>() : Vec3(0.48, 0.6, 0.64).head<Dim>();
  const Vec<Dim> shear = Vec3(0.7, -1.1, 0.4).head<Dim>();
  const auto distance = [&](const Vec<Dim>& x) { return std::max(0.0, normal.dot(x) - (Dim == 2 ? 0.4217 : 0.8217)); };
  p.set(p.u, [&](int a, const Vec<Dim>& x) { return shear[a] * distance(x); });
  FaceField<Dim> flux(p.layout());
  add_no_slip_flux(p.input(), *p.system.samples, {RigidField{}}, p.u, flux);
  int cut = 0;
  double faces = 0, slits = 0;
  for (const auto& [a, f] : p.system.rows.faces) {
    const double w = p.step.faces.open.at(a, f);
    const Vec<Dim> x = p.position(a, f);
    if (w == 1 || x.minCoeff() < 1.6 / n || x.maxCoeff() > 1 - 1.6 / n) continue;
    ++cut;
    double sum = 0;
    constexpr int fine = 200;
    for (int i = 0; i < (Dim == 2 ? fine : fine * fine); ++i) {
      Vec<Dim> y = x;
      y[(a + 1) % Dim] += ((i % fine + 0.5) / fine - 0.5) / n;
      if (Dim == 3) y[(a + 2) % Dim] += ((i / fine + 0.5) / fine - 0.5) / n;
      sum += shear[a] * distance(y) / (Dim == 2 ? fine : fine * fine);
    }
    double& worst = w < 0.05 ? slits : faces;
    worst = std::max(worst, std::abs(w * p.u.at(a, f) + flux.at(a, f) - sum));
  }
  CHECK(cut > 0);
  CHECK(faces <= 1e-4 * shear.norm() / n);  // error of the sums over 200 points an axis
  CHECK(slits <= 2e-3 * shear.norm() / n);  // slits with all neighbours too near the wall: their whole flux
}

}  // namespace

TEST_CASE("no-slip fluxes of a shear", "[viscous]") {
  check_flux<2>(16);
  check_flux<3>(8);
}

}  // namespace viscous_couette_tests
