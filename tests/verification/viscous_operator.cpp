// Algebra of the viscous operator: symmetry, positivity, what costs nothing.
#include <catch2/catch.hpp>
#include <chrono>
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

// Interior rows of uniform full liquid: the Laplacian of each component, D and D' adjoint, D M^-1 D' the pressure
// matrix.
template <int Dim>
void check_interior(int n) {
  typename ViscousProblem<Dim>::Settings s;
  s.cells = n;
  s.viscosity = 0.7, s.dt = 1.9, s.density = 3;
  s.solids = {viscous_ball(middle<Dim>(), 0.2345)};
  ViscousProblem<Dim> p(s);
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
  typename ViscousProblem<Dim>::Settings s;
  s.cells = n;
  s.sides = SideType::outflow;
  s.viscosity = 0.7, s.dt = 1.9, s.density = 3;
  s.solids = {viscous_ball(middle<Dim>(), 0.2345)};
  s.phi = tilted_surface<Dim>;
  ViscousProblem<Dim> p(s);
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

// The load on a free body is what its rows say, and the dissipation rate what the matrices say.
template <int Dim>
void check_loads(int n) {
  typename ViscousProblem<Dim>::Settings s;
  s.cells = n;
  s.dt = 1.9;
  s.solids = {viscous_ball(middle<Dim>(), 0.2345), viscous_ball(Vec3(0.9, 0.1, 0), 0.2)};
  s.phi = tilted_surface<Dim>;
  ViscousProblem<Dim> p(s);
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
  CHECK(viscous_dissipation(p.input(), p.system, p.u, v) == Approx(z.dot(Vz)).epsilon(1e-12));
  CHECK(loads[1].force.norm() > 0);
}

// A channel between no-slip walls with an inflow and an outflow side: the stream leaves as it came. The profile
// is that of the scheme: half a cell from a wall the velocity is (n - 1/4)/2 instead of n/2 - 1/4 (in h^2).
double outflow_disturbance(bool uniform) {
  constexpr int n = 12;
  const std::string profile = fmt::format("y*(1-y)+{:.17g}", 0.25 / (n * n));
  ViscousProblem<2> p({.cells = n, .sides = SideType::no_slip, .dt = 1e7, .solids = {}}, [&](Scene& scene) {
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

// V is positive wherever solids and surface cut the cells, with and without a free surface, of one viscosity or many.
TEST_CASE("viscous positive", "[viscous]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  double least = 0;
  for (int trial = 0; trial < 24; ++trial) {
    ViscousProblem<3>::Settings s;
    s.cells = 7;
    const Vec3 center = Vec3::Constant(0.5) + 0.1 * Vec3(some(random), some(random), some(random));
    s.solids = {viscous_ball(center, 0.3 + 0.12 * some(random), trial % 2 == 0)};
    const Vec3 up = Vec3(some(random), some(random), some(random)).normalized();
    const double level = 0.3 * some(random);
    s.phi = [&](const Vec3& x) { return up.dot(x - Vec3::Constant(0.5)) - level; };
    if (trial % 4 < 2) s.sides = SideType::free_slip;
    if (trial % 3 == 0) s.sides = SideType::outflow;
    ViscousProblem<3> p(s);
    p.uniform = trial % 5 != 0;
    if (!p.uniform)
      for_each_index_in_order(p.layout(), p.layout().padded(),
                              [&](Site c, const IVec<3>&) { p.viscosity[c] = std::pow(10, 3 * some(random)); });
    p.release(0, center);
    p.assemble();
    const Eigen::MatrixXd V = p.dense(false);
    const auto e = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(V, Eigen::EigenvaluesOnly).eigenvalues().eval();
    least = std::min(least, e[0] / e[e.size() - 1]);
    CAPTURE(trial);
    CHECK(e[0] >= -1e-12 * e[e.size() - 1]);  // round-off of the sums
  }
}

// Shear of layers a thousand times as viscous as each other: the stress is the same in all, to round-off.
TEST_CASE("viscous layers", "[viscous]") {
  constexpr int n = 12;
  ViscousProblem<2>::Settings s;
  s.cells = n, s.dt = 1e9;
  ViscousProblem<2> p(s, [](Scene& scene) {
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
    CHECK(std::abs(p.u.at(a, f) - (a == 0 ? u : 0)) <= 1e-7);  // what the inertia of a step of 1e9 s leaves
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
  WARN(outflow_disturbance(true) << " " << outflow_disturbance(false));
  // Relative to velocities up to 0.25; dt leaves a part of the inertia.
  CHECK(outflow_disturbance(true) <= 1e-6);
  CHECK(outflow_disturbance(false) <= 1e-6);
}

TEST_CASE("viscous operator 2D", "[viscous]") {
  check_cases<2>(17);
}

TEST_CASE("viscous operator 3D", "[viscous]") {
  check_cases<3>(9);
}

TEST_CASE("viscous timing", "[.]") {
  for (int mode = 0; mode < 3; ++mode) {
    ViscousProblem<3>::Settings s;
    s.cells = 64;
    s.solids = {viscous_ball(middle<3>(), 0.2345)};
    if (mode == 1) s.phi = tilted_surface<3>;
    ViscousProblem<3> p(s);
    p.uniform = mode < 2;
    p.release(0, middle<3>());
    const auto t0 = std::chrono::steady_clock::now();
    p.assemble();
    const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    WARN("mode " << mode << " rows " << p.system.F.rows() << " entries " << p.system.F.value.size() << " " << t
                 << " s");
  }
}

TEST_CASE("viscous ranks", "[.]") {
  ViscousProblem<3>::Settings s;
  s.cells = 20;
  s.dt = 1.7;
  s.solids = {viscous_ball(middle<3>(), 0.2345)};
  s.phi = tilted_surface<3>;
  ViscousProblem<3> p(s);
  p.release(0, middle<3>());
  const auto wave = [](int a, const Vec<3>& x) { return std::sin(3 * x[0] + a) * std::cos(2 * x[1] - a) + x[2]; };
  p.set(p.u_star, wave);
  p.set(p.u, wave);
  p.assemble();
  Communicator ranks;
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(6, 0.3, 1.1);
  const auto loads = viscous_forces(p.input(), p.system, p.u, v, {middle<3>()});
  FaceField<3, std::int64_t> row = p.system.rows.row;
  std::vector<double> z(p.system.rows.global), f(z.size()), Fz(z.size());
  for (std::size_t i = 0; i < p.system.rows.faces.size(); ++i)
    z[p.system.rows.first + i] = p.u.at(p.system.rows.faces[i].first, p.system.rows.faces[i].second);
  ranks.global_sum(z);
  double energy = 0, right = 0;
  for (int i = 0; i < p.system.F.rows(); ++i) {
    const Row r = p.system.rows.first + i;
    for (int k = p.system.F.row_start[i]; k < p.system.F.row_start[i + 1]; ++k)
      energy += z[r] * p.system.F.value[k] * z[p.system.F.column[k]];
    energy -= p.system.mass[i] * z[r] * z[r];
    right += p.system.f[i] * z[r];
  }
  p.system.G.for_each([&](int i, int k, double value) { energy += 2 * z[p.system.rows.first + i] * value * v[k]; });
  energy = ranks.global_sum(energy);
  energy += v.dot(p.system.Hvv * v);
  right = ranks.global_sum(right);
  double dz = 0, qs = 0;
  for (int i = 0; i < p.system.D.rows(); ++i) {
    double sum = 0;
    for (int k = p.system.D.row_start[i]; k < p.system.D.row_start[i + 1]; ++k)
      sum += p.system.D.value[k] * z[p.system.D.column[k]];
    dz += sum * sum;
    qs += p.system.q[i] * p.system.q[i];
  }
  dz = ranks.global_sum(dz);
  const double Phi = viscous_dissipation(p.input(), p.system, p.u, v);
  if (ranks.is_root())
    printf("rows %ld energy %.15g dissipation %.15g right %.15g D %.15g q %.15g force %.15g torque %.15g\n",
           long(p.system.rows.global), energy / s.dt, Phi, right, dz, qs, loads[0].force.norm(),
           loads[0].torque.norm());
}
