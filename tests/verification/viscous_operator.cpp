// Algebra of the viscous operator: symmetry, positivity, what costs nothing.
#include <catch2/catch.hpp>
#include <random>

#include <Eigen/Eigenvalues>

#include "viscous_problem.h"

using namespace seiche;
using namespace seiche::test;

namespace {

// Liquid below a tilted plane.
template <int Dim>
double tilted_surface(const Vec<Dim>& x) {
  return 0.9 * (x[1] - 0.61) + 0.3 * (x[0] - 0.5) + (Dim == 3 ? 0.2 * (x[Dim - 1] - 0.5) : 0);
}

template <int Dim>
Vec3 middle() {
  Vec3 c = Vec3::Zero();
  c.head<Dim>().setConstant(0.5);
  return c + 0.013 * Vec3::UnitX();
}

template <int Dim>
double wet(const Vec<Dim>&) {
  return -1;
}

template <int Dim>
void check_symmetry(ViscousProblem<Dim>& p) {
  p.assemble();
  const Eigen::MatrixXd K = p.dense(true);
  CHECK((K - K.transpose()).cwiseAbs().maxCoeff() <= 1e-13 * K.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd V = p.dense(false);
  const Eigen::VectorXd e = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(V, Eigen::EigenvaluesOnly).eigenvalues();
  WARN("smallest " << e[0] << ", largest " << e[e.size() - 1] << ", size " << e.size());
  CHECK(e[0] >= -1e-12 * e[e.size() - 1]);  // round-off of the sums
}

// A ball whose twist is unknown in a liquid that moves with it: nothing acts.
template <int Dim>
void check_invariance(ViscousProblem<Dim>& p, const RigidField& motion) {
  p.assemble();
  const Eigen::MatrixXd V = p.dense(false);
  Eigen::VectorXd z(V.rows());
  const int n = int(p.system.rows.faces.size());
  for (int i = 0; i < n; ++i) {
    const auto [a, f] = p.system.rows.faces[i];
    z[i] = motion.at(extend<Dim>(p.position(a, f)))[a];
  }
  for (const auto& s : p.solids) {
    if (s.first_unknown < 0) continue;
    z.segment(n + s.first_unknown, Dim) = motion.at(s.frame.center).template head<Dim>();
    z.segment(n + s.first_unknown + Dim, Dim == 2 ? 1 : 3) = Dim == 2 ? motion.angular.tail(1) : motion.angular;
  }
  Eigen::VectorXd known = Eigen::VectorXd::Zero(V.rows());
  for (int i = 0; i < n; ++i)
    known[i] =
        p.system.f[i] - p.system.mass[i] * p.u_star.at(p.system.rows.faces[i].first, p.system.rows.faces[i].second);
  known.tail(p.unknowns) = p.system.g;
  const double scale = (V.cwiseAbs() * z.cwiseAbs()).maxCoeff();
  Eigen::Index worst;
  const double most = (V * z - known).cwiseAbs().maxCoeff(&worst);
  if (worst < n)
    INFO("face " << p.system.rows.faces[worst].first << " at "
                 << p.position(p.system.rows.faces[worst].first, p.system.rows.faces[worst].second).transpose());
  INFO("most " << most << " of " << scale << " at " << worst << " of " << n);
  CHECK(most <= 1e-12 * scale);
}

template <int Dim>
void check_cases(int n) {
  typename ViscousProblem<Dim>::Settings s;
  s.cells = n;
  const RigidField spin{Vec3(0.3, -0.2, Dim == 3 ? 0.1 : 0), Dim == 3 ? Vec3(0.4, -0.7, 1.1) : Vec3(0, 0, 1.3),
                        middle<Dim>()};
  SECTION("ball in full liquid, free") {
    s.solids = {viscous_ball(middle<Dim>(), 0.2345)};
    s.sides = SideType::free_slip;
    ViscousProblem<Dim> p(s);
    p.release(0, middle<Dim>());
    check_symmetry(p);
  }
  SECTION("ball in a free blob") {
    s.solids = {viscous_ball(middle<Dim>(), 0.1945)};
    s.phi = [](const Vec<Dim>& x) { return (x - middle<Dim>().template head<Dim>()).norm() - 0.37; };
    ViscousProblem<Dim> p(s);
    p.release(0, middle<Dim>());
    check_symmetry(p);
    check_invariance(p, spin);
    ViscousProblem<Dim> q(s);
    q.move(0, spin);
    check_invariance(q, spin);
  }
  SECTION("blob that a ball and a free-slip ball cut") {
    const Vec3 aside = middle<Dim>() + 0.25 * Vec3::UnitX();
    s.solids = {viscous_ball(middle<Dim>() - 0.2 * Vec3::UnitX(), 0.15), viscous_ball(aside, 0.12)};
    s.solids[1].slip = Slip::free_slip;
    s.phi = [](const Vec<Dim>& x) { return (x - middle<Dim>().template head<Dim>()).norm() - 0.33; };
    ViscousProblem<Dim> p(s);
    p.release(0, middle<Dim>());
    p.release(1, aside);
    check_symmetry(p);
    check_invariance(p, spin);
  }
  SECTION("container half full, varying viscosity") {
    s.solids = {viscous_ball(middle<Dim>(), 0.36, true)};
    s.phi = tilted_surface<Dim>;
    ViscousProblem<Dim> p(s);
    p.release(0, middle<Dim>());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-5, 0);
    for_each_index_in_order(p.layout(), p.layout().padded(),
                            [&](Site c, const IVec<Dim>&) { p.viscosity[c] = std::pow(10, exponent(random)); });
    p.uniform = false;
    check_symmetry(p);
    check_invariance(p, spin);
  }
  SECTION("container half full") {
    s.solids = {viscous_ball(middle<Dim>(), 0.36, true)};
    s.phi = tilted_surface<Dim>;
    ViscousProblem<Dim> p(s);
    p.release(0, middle<Dim>());
    check_symmetry(p);
    check_invariance(p, spin);
  }
  SECTION("outflow sides") {
    s.sides = SideType::outflow;
    ViscousProblem<Dim> p(s);
    check_symmetry(p);
    s.phi = tilted_surface<Dim>;
    ViscousProblem<Dim> q(s);
    check_symmetry(q);
  }
}

}  // namespace

TEST_CASE("viscous operator 2D", "[viscous]") {
  check_cases<2>(17);
}

TEST_CASE("viscous operator 3D", "[viscous]") {
  check_cases<3>(9);
}
