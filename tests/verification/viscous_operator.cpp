// Algebra of the viscous operator: symmetry, positivity, null vectors.
#include <catch2/catch.hpp>
#include <random>

#include "base/scene.h"
#include "linalg/core/symmetric_eigen.h"
#include "viscous_case.h"

namespace viscous_operator_tests {
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
void check_symmetry(ViscousCase<Dim>& p) {
  p.assemble();
  const Eigen::MatrixXd K = p.dense(true);
  CHECK((K - K.transpose()).cwiseAbs().maxCoeff() <= 1e-13 * K.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd V = p.dense(false);
  const Eigen::VectorXd e = symmetric_eigenvalues(V);
  CHECK(e[0] >= -1e-12 * e[e.size() - 1]);  // round-off of the sums
}

// A ball with an unknown twist in liquid that moves with it: there is no viscous force.
template <int Dim>
void check_invariance(ViscousCase<Dim>& p, const RigidField& motion) {
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
  INFO("most " << most << " of " << scale << " at " << worst << " of " << n);
  CHECK(most <= 1e-12 * scale);
}

template <int Dim>
RigidField some_spin() {
  return {Vec3(0.3, -0.2, Dim == 3 ? 0.1 : 0), Dim == 3 ? Vec3(0.4, -0.7, 1.1) : Vec3(0, 0, 1.3), middle<Dim>()};
}

template <int Dim>
void check_blobs(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  SECTION("ball in a free blob") {
    s.solids = {viscous_ball(middle<Dim>(), 0.1945)};
    s.phi = [](const Vec<Dim>& x) { return (x - middle<Dim>().template head<Dim>()).norm() - 0.37; };
    ViscousCase<Dim> p(s);
    p.release(0, middle<Dim>());
    check_symmetry(p);
    check_invariance(p, some_spin<Dim>());
    ViscousCase<Dim> q(s);
    q.move(0, some_spin<Dim>());
    check_invariance(q, some_spin<Dim>());
  }
  SECTION("blob that a ball and a free-slip ball cut") {
    const Vec3 aside = middle<Dim>() + 0.25 * Vec3::UnitX();
    s.solids = {viscous_ball(middle<Dim>() - 0.2 * Vec3::UnitX(), 0.15), viscous_ball(aside, 0.12)};
    s.solids[1].slip = Slip::free_slip;
    s.phi = [](const Vec<Dim>& x) { return (x - middle<Dim>().template head<Dim>()).norm() - 0.33; };
    ViscousCase<Dim> p(s);
    p.release(0, middle<Dim>());
    p.release(1, aside);
    check_symmetry(p);
    check_invariance(p, some_spin<Dim>());
  }
}

// A half-full spherical container, with uniform or random viscosity.
template <int Dim>
void check_container(int n, bool uniform) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  s.solids = {viscous_ball(middle<Dim>(), 0.36, true)};
  s.phi = tilted_surface<Dim>;
  ViscousCase<Dim> p(s);
  p.release(0, middle<Dim>());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-5, 0);
  p.uniform = uniform;
  for_each_index_in_order(p.layout(), p.layout().padded(), [&](Site c, const IVec<Dim>&) {
    if (!uniform) p.viscosity[c] = std::pow(10, exponent(random));
  });
  check_symmetry(p);
  check_invariance(p, some_spin<Dim>());
}

template <int Dim>
void check_cases(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  check_blobs<Dim>(n);
  SECTION("ball in full liquid, free") {
    s.solids = {viscous_ball(middle<Dim>(), 0.2345)};
    s.sides = SideType::free_slip;
    ViscousCase<Dim> p(s);
    p.release(0, middle<Dim>());
    check_symmetry(p);
  }
  SECTION("container half full, varying viscosity") {
    check_container<Dim>(n, false);
  }
  SECTION("container half full") {
    check_container<Dim>(n, true);
  }
  SECTION("outflow sides") {
    s.sides = SideType::outflow;
    s.cells = Dim == 2 ? n : 6;
    ViscousCase<Dim> p(s);
    check_symmetry(p);
    s.phi = tilted_surface<Dim>;
    ViscousCase<Dim> q(s);
    check_symmetry(q);
  }
}

// Interior rows in full liquid of uniform viscosity: V is the Laplacian of each component, D and D' are adjoint, D M^-1
// D' is the pressure matrix.
template <int Dim>
void check_interior(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  s.viscosity = 0.7, s.dt = 1.9, s.density = 3;
  s.solids = {viscous_ball(middle<Dim>(), 0.2345)};
  ViscousCase<Dim> p(s);
  p.move(0, {Vec3::Zero(), Vec3::UnitZ(), middle<Dim>()});
  p.assemble();
  const double c = s.viscosity * s.dt * std::pow(1.0 / n, Dim - 2), whole = s.density * std::pow(1.0 / n, Dim);
  int interior = 0;
  double worst = 0;
  for (int i = 0; i < p.system.F.rows(); ++i) {
    const auto [a, f] = p.system.rows.faces[i];
    const Vec<Dim> x = p.position(a, f);
    const bool near_side = x.minCoeff() < 1.6 / n || x.maxCoeff() > 1 - 1.6 / n;
    if (near_side || p.face_psi(a, f) < 1.3 / n) continue;
    ++interior;
    const int begin = p.system.F.row_start[i], end = p.system.F.row_start[i + 1];
    REQUIRE(end - begin == 2 * Dim + 1);
    worst = std::max(worst, std::abs(p.system.F.value[begin] - whole - 2 * Dim * c));
    for (int k = begin + 1; k < end; ++k) worst = std::max(worst, std::abs(p.system.F.value[k] + c));
  }
  CHECK(interior > 0);
  CHECK(worst <= 1e-14 * c * 2 * Dim);
}

template <int Dim>
void check_divergence(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  s.sides = SideType::outflow;
  s.viscosity = 0.7, s.dt = 1.9, s.density = 3;
  s.solids = {viscous_ball(middle<Dim>(), 0.2345)};
  s.phi = tilted_surface<Dim>;
  ViscousCase<Dim> p(s);
  p.move(0, {Vec3::UnitX(), Vec3::UnitZ(), middle<Dim>()});
  p.set(p.u_star, [](int a, const Vec<Dim>& x) { return std::sin(3 * x[0] + a) * std::cos(2 * x[1] - a); });
  p.assemble();
  const int faces = p.system.F.rows(), cells = p.system.D.rows();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(cells, faces), Dt = Eigen::MatrixXd::Zero(faces, cells),
                  A = Eigen::MatrixXd::Zero(cells, cells);
  p.visit(p.system.D, [&](int i, int j, double v) { D(i, j) += v; });
  p.visit(p.system.Dt, [&](int i, int j, double v) { Dt(i, j) += v; });
  CHECK((D - Dt.transpose()).cwiseAbs().maxCoeff() == 0);
  p.visit(assemble_pressure_matrix(p.projection(), p.rows), [&](int i, int j, double v) { A(i, j) += v; });
  A *= std::pow(1.0 / n, Dim - 2) / s.density;
  Eigen::VectorXd inverse(faces), f(faces), q(cells);
  for (int i = 0; i < faces; ++i) inverse[i] = 1 / p.system.mass[i];
  CHECK((D * inverse.asDiagonal() * Dt - A).cwiseAbs().maxCoeff() <= 1e-12 * A.cwiseAbs().maxCoeff());
  // Without viscosity the system is the projection: D M^-1 D' p^ = D u* - q, p^ = -dt p.
  const std::vector<double> b = pressure_right_side(p.projection(), p.rows, p.u_star);
  for (int i = 0; i < faces; ++i) {
    const auto [a, face] = p.system.rows.faces[i];
    f[i] = p.system.mass[i] * p.u_star.at(a, face);
  }
  for (int i = 0; i < cells; ++i) q[i] = p.system.q[i];
  const Eigen::VectorXd right = D * (inverse.asDiagonal() * f) - q;
  double worst = 0;
  for (int i = 0; i < cells; ++i)
    worst = std::max(worst, std::abs(right[i] + b[i] * s.dt * std::pow(1.0 / n, Dim - 2) / s.density));
  CHECK(worst <= 1e-12 * right.cwiseAbs().maxCoeff());
}

// The load on a free body follows from its rows, the dissipation rate from the matrices.
template <int Dim>
void check_loads(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n;
  s.dt = 1.9;
  s.solids = {viscous_ball(middle<Dim>(), 0.2345), viscous_ball(Vec3(0.9, 0.1, 0), 0.2)};
  s.phi = tilted_surface<Dim>;
  ViscousCase<Dim> p(s);
  p.release(0, middle<Dim>());
  p.assemble();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-1, 1);
  const int faces = p.system.F.rows();
  Eigen::VectorXd z(faces + p.unknowns);
  for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = some(random);
  for (int i = 0; i < faces; ++i) p.u.at(p.system.rows.faces[i].first, p.system.rows.faces[i].second) = z[i];
  const Eigen::VectorXd v = z.tail(p.unknowns), Vz = p.dense(false) * z / s.dt;
  const auto loads = viscous_forces(p.input(), p.system, p.u, v, {middle<Dim>(), Vec3::Zero()});
  Eigen::VectorXd load(p.unknowns);
  load.head(Dim) = loads[0].force.template head<Dim>();
  load.tail(Dim == 2 ? 1 : 3) = Dim == 2 ? loads[0].torque.tail(1) : loads[0].torque;
  CHECK((load + Vz.tail(p.unknowns)).norm() <= 1e-12 * load.norm());
  Eigen::VectorXd earlier = Eigen::VectorXd::Zero(z.size());  // the liquid at rest, the body with half of v
  earlier.tail(p.unknowns) = v / 2;
  FaceField<Dim> rest = p.u;
  for (const auto& [a, f] : p.system.rows.faces) rest.at(a, f) = 0;
  const ViscousPower power = viscous_power(p.input(), p.system, {p.u, v}, {p.u, v}, {rest, v / 2});
  CHECK(power.dissipation == Approx(z.dot(Vz)).epsilon(1e-12));
  CHECK(power.before == Approx(earlier.dot(Vz)).epsilon(1e-12));
  CHECK(loads[1].force.norm() > 0);
}

// A channel between no-slip walls with an inflow and an outflow side: the profile must leave unchanged. It is the
// discrete profile: half a cell from a wall the velocity is (n - 1/4)/2 instead of n/2 - 1/4 (in h^2).
double outflow_disturbance(bool uniform) {
  constexpr int n = 12;
  const std::string profile = fmt::format("y*(1-y)+{:.17g}", 0.25 / (n * n));
  ViscousCase<2> p({.cells = n, .sides = SideType::no_slip, .dt = 1e7, .solids = {}}, [&](Scene& scene) {
    scene.domain.sides[0][0].type = SideType::inflow;
    scene.domain.sides[0][0].velocity = {profile, "0", "0"};
    scene.domain.sides[0][1].type = SideType::outflow;
  });
  p.uniform = uniform;
  p.assemble();
  p.solve();
  REQUIRE(p.solved);
  double worst = 0;
  for (const auto& [a, f] : p.system.rows.faces) {
    const Vec<2> x = p.position(a, f);
    worst = std::max(worst, std::abs(p.u.at(a, f) - (a == 0 ? x[1] * (1 - x[1]) + 0.25 / (n * n) : 0)));
  }
  return worst;
}

}  // namespace

// A plane solid that deforms by modes of its surface which form a twist. If the liquid makes the same motion, there is
// no viscous force in the rotating frame. The operator stays symmetric and positive.
template <int Dim>
void check_surface(int n) {
  typename ViscousCase<Dim>::Settings s;
  s.cells = n, s.sides = SideType::free_slip;
  SolidSpec plane = viscous_solid("expression");
  plane.shape.phi = Dim == 2 ? "0.6*x+0.8*y-0.4217" : "0.48*x+0.6*y+0.64*z-0.4217";
  s.solids = {plane};
  s.phi = [](const Vec<Dim>& x) { return (x - middle<Dim>().template head<Dim>()).norm() - 0.31; };
  ViscousCase<Dim> p(s);
  const Vec3 normal = Dim == 2 ? Vec3(0.6, 0.8, 0) : Vec3(0.48, 0.6, 0.64), center = middle<Dim>();
  const RigidField spin = some_spin<Dim>();
  p.release(0, center);
  p.solids[0].rigid = false;
  p.solids[0].frame = spin;
  p.solids[0].surface = [&](int axis, Site f, std::vector<std::pair<int, double>>& weights) {
    const Vec3 x = extend<Dim>(p.position(axis, f)), r = x - (normal.dot(x) - 0.4217) * normal - center;
    weights.emplace_back(axis, 1);
    if (Dim == 2) weights.emplace_back(2, Vec3::UnitZ().cross(r)[axis]);
    for (int c = 0; Dim == 3 && c < 3; ++c) weights.emplace_back(3 + c, Vec3::Unit(c).cross(r)[axis]);
  };
  check_symmetry(p);
  check_invariance(p, spin);
}

TEST_CASE("viscous surface", "[viscous]") {
  check_surface<2>(17);
  check_surface<3>(9);
}

// V is positive for any cuts by solids and surface, with and without a free surface, for uniform and variable
// viscosity.
TEST_CASE("viscous positive", "[viscous]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  double least = 0;
  for (int trial = 0; trial < 24; ++trial) {
    ViscousCase<3>::Settings s;
    s.cells = 7;
    const Vec3 center = Vec3::Constant(0.5) + 0.1 * Vec3(some(random), some(random), some(random));
    s.solids = {viscous_ball(center, 0.3 + 0.12 * some(random), trial % 2 == 0)};
    const Vec3 up = Vec3(some(random), some(random), some(random)).normalized();
    const double level = 0.3 * some(random);
    s.phi = [&](const Vec3& x) { return up.dot(x - Vec3::Constant(0.5)) - level; };
    if (trial % 4 < 2) s.sides = SideType::free_slip;
    if (trial % 3 == 0) s.sides = SideType::outflow;
    ViscousCase<3> p(s);
    p.uniform = trial % 5 != 0;
    if (!p.uniform)
      for_each_index_in_order(p.layout(), p.layout().padded(),
                              [&](Site c, const IVec<3>&) { p.viscosity[c] = std::pow(10, 3 * some(random)); });
    p.release(0, center);
    p.assemble();
    const Eigen::MatrixXd V = p.dense(false);
    const Eigen::VectorXd e = symmetric_eigenvalues(V);
    least = std::min(least, e[0] / e[e.size() - 1]);
    CAPTURE(trial);
    CHECK(e[0] >= -1e-12 * e[e.size() - 1]);  // round-off of the sums
  }
}

// Shear of layers with a viscosity ratio of 1000: the stress is uniform up to round-off.
TEST_CASE("viscous layers", "[viscous]") {
  constexpr int n = 12;
  ViscousCase<2>::Settings s;
  s.cells = n, s.dt = 1e9;
  ViscousCase<2> p(s, [](Scene& scene) {
    for (SideSpec& side : scene.domain.sides[0]) side.type = SideType::periodic;
    scene.domain.sides[1][1].type = SideType::moving_wall;
    scene.domain.sides[1][1].velocity = {"1", "0", "0"};
  });
  p.uniform = false;
  for_each_index_in_order(p.layout(), p.layout().padded(),
                          [&](Site c, const IVec<2>& i) { p.viscosity[c] = i[1] < n / 3 ? 1000 : 1; });
  p.assemble();
  p.solve();
  REQUIRE(p.solved);
  const double stress = 1 / (2.0 / 3 + 1e-3 / 3);
  for (const auto& [a, f] : p.system.rows.faces) {
    const double y = p.position(a, f)[1];
    const double u = y < 1.0 / 3 ? stress * y / 1000 : 1 - stress * (1 - y);
    CHECK(std::abs(p.u.at(a, f) - (a == 0 ? u : 0)) <= 1e-7);  // remaining inertia of a step of 1e9 s
  }
}

TEST_CASE("viscous interior", "[viscous]") {
  check_interior<2>(20);
  check_interior<3>(16);
}

TEST_CASE("viscous divergence", "[viscous]") {
  check_divergence<2>(17);
  check_divergence<3>(9);
}

TEST_CASE("viscous loads", "[viscous]") {
  check_loads<2>(17);
  check_loads<3>(9);
}

TEST_CASE("viscous outflow", "[viscous]") {
  // Relative to velocities of up to 0.25; the finite dt leaves a part of the inertia.
  CHECK(outflow_disturbance(true) <= 1e-7);
  CHECK(outflow_disturbance(false) <= 1e-7);
}

TEST_CASE("viscous operator 2D", "[viscous]") {
  check_cases<2>(17);
}

TEST_CASE("viscous operator 3D", "[viscous]") {
  check_cases<3>(9);
}

}  // namespace viscous_operator_tests
