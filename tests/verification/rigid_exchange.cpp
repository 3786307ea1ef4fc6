// Momentum exchange of one projection between liquid, rigid bodies, static solids and walls, on random scenes.
#include "base/scene.h"
#include "exchange.h"
#include "lu_solves.h"

namespace rigid_exchange_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

SolidSpec random_solid(Dice& dice, int dim, int number) {
  SolidSpec s;
  s.name = fmt::format("solid{}", number);
  s.kind = number < 2 ? SolidKind::fixed : SolidKind::rigid;
  s.shape.where = "test";
  s.shape.kind = number % 2 == 0 ? "sphere" : "box";
  s.shape.radius = dice(0.1, 0.2);
  s.shape.upper = dice.vector(dim, 0.07, 0.2);
  s.shape.lower = -s.shape.upper;
  s.shape.transform.translate = dice.vector(dim, 0, 1);
  s.shape.transform.rotate = {dim == 2 ? Vec3(0, 0, 1) : Vec3(dice.vector(3, 0.1, 1)), dice(0, 90)};
  s.rigid.density = std::pow(10, dice(1, 5));
  s.rigid.velocity = dice.vector(dim, -1, 1);
  s.rigid.angular_velocity = dim == 3 ? dice.vector(3, -5, 5) : Vec3(0, 0, dice(-5, 5));
  return s;
}

// Four rigid bodies and two static solids at random positions: across walls, the surface and each other.
Scene random_scene(int dim, Filling filling, double tolerance, int seed) {
  Scene s = test::box_scene(dim, dim == 2 ? 19 : 11);
  test::add_liquid(s, "-1");  // Projection has a level set of its own
  Dice dice{std::mt19937(unsigned(seed))};
  s.gravity = dice.vector(dim, -10, 10);
  s.solver.tolerance = tolerance;
  for (int k = 0; k < 6; ++k) s.solids.push_back(random_solid(dice, dim, k));
  if (filling == Filling::outflow) s.domain.sides[0][1] = {SideType::outflow, {"0", "0", "0"}, "300"};
  return s;
}

template <class Check>
void for_random_projections(std::initializer_list<Filling> fillings, double tolerance, const Check& check) {
  for (const Filling filling : fillings)
    for (int seed = 0; seed < 5; ++seed) {
      check(Projection<2>(random_scene(2, filling, tolerance, seed), filling, seed));
      check(Projection<3>(random_scene(3, filling, tolerance, seed), filling, seed));
    }
}

// Kinetic energy 1/2 sum m u^2 + 1/2 v'Mv.
template <int Dim, class Velocity>
double kinetic_energy(const Projection<Dim>& p, const Eigen::VectorXd& v, const Velocity& u) {
  double sum = 0.5 * v.dot(p.coupling.mass * v);
  p.for_each_unknown([&](int a, Site f, const Vec3&, double m) { sum += 0.5 * m * std::pow(u(a, f), 2); });
  return sum;
}

// Pressures of [A, c1 J; -c2 J', M] (p, v) = (b, M v*) by dense elimination.
template <int Dim>
Eigen::VectorXd saddle_pressures(const Projection<Dim>& p) {
  const ProjectionInput<Dim> in = p.input();
  const double h = p.setup.domain.layout.h(), c1 = p.setup.fluids.density() * h / dt, c2 = dt * std::pow(h, Dim - 1);
  const DistributedMatrix A = assemble_pressure_matrix(in, p.rows);
  const Vector b = pressure_right_side(in, p.rows, p.u_star);
  const int n = A.rows(), m = int(p.coupling.target.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m);
  for (int i = 0; i < n; ++i)
    for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k) K(i, A.column[k]) += A.value[k];
  for (int j = 0; j < m; ++j) {
    Vector column(std::size_t(n), 0.0);
    add_multiplied(p.coupling.J, Eigen::VectorXd::Unit(m, j), column);
    for (int i = 0; i < n; ++i) K(i, n + j) = c1 * column[i], K(n + j, i) = -c2 * column[i];
  }
  K.bottomRightCorner(m, m) = Eigen::MatrixXd(p.coupling.mass);
  Eigen::VectorXd right(n + m);
  right << Eigen::Map<const Eigen::VectorXd>(b.data(), n), p.coupling.mass * p.coupling.target;
  // Rows are scaled by their diagonals, since densities differ by 1e10.
  const Eigen::VectorXd scale = K.diagonal().cwiseInverse();
  return testing::dense_lu_solve(scale.asDiagonal() * K, scale.cwiseProduct(right)).head(n);
}

}  // namespace

TEST_CASE("the flux a body pushes and the force the pressure exerts on it are transposes") {
  double worst = 0;
  for_random_projections({Filling::closed, Filling::surface, Filling::outflow}, 1e-8,
                         [&](auto p) { worst = std::max(worst, adjointness_error(p)); });
  WARN("<p, J v> against <J'p, v>: " << worst << ", bar 1e-12");
  CHECK(worst <= 1e-12);
}

TEST_CASE("momentum of liquid and bodies changes by gravity and by what walls, static solids and open sides give") {
  double linear = 0, angular = 0;
  for_random_projections({Filling::closed, Filling::surface, Filling::outflow}, 1e-8, [&](auto p) {
    p.solve();
    const Balance balance(p);
    linear = std::max(linear, balance.error(&Momentum::linear));
    angular = std::max(angular, balance.error(&Momentum::angular));
  });
  WARN("imbalance over the largest term: linear " << linear << ", angular " << angular << ", bar 1e-11");
  CHECK(linear <= 1e-11);
  CHECK(angular <= 1e-11);
}

TEST_CASE("the projection takes kinetic energy of liquid and bodies, by that of what it takes away") {
  double worst = 0;
  for_random_projections({Filling::closed, Filling::surface}, 1e-12, [&](auto p) {
    p.solve();
    const Eigen::VectorXd v = p.velocities(), target = p.coupling.target;
    const auto now = [&](int a, Site f) { return p.velocity(a, f); };
    const auto star = [&](int a, Site f) { return p.u_star.at(a, f); };
    const double before = kinetic_energy(p, target, star), after = kinetic_energy(p, v, now);
    const double taken = kinetic_energy(p, target - v, [&](int a, Site f) { return star(a, f) - now(a, f); });
    CHECK(after < before);
    worst = std::max(worst, std::abs(before - after - taken) / before);
  });
  // Both parts are orthogonal up to the accuracy of the solve: 1e-12 of the fluxes.
  WARN("E(u*) - E(u) - E(u* - u) over E(u*): " << worst << ", bar 1e-11");
  CHECK(worst <= 1e-11);
}

TEST_CASE("the bodies eliminated leave the pressure of the whole system") {
  double worst = 0;
  for (int seed = 0; seed < 5; ++seed) {
    Projection<2> p(random_scene(2, Filling::surface, 3e-14, seed), Filling::surface, seed);
    const Eigen::VectorXd whole = saddle_pressures(p);
    p.solve();
    double error = 0;
    for (std::size_t n = 0; n < p.rows.cells.size(); ++n)
      error = std::max(error, std::abs(p.state.pressure[p.rows.cells[n]] - whole[Eigen::Index(n)]));
    worst = std::max(worst, error / whole.cwiseAbs().maxCoeff());
  }
  WARN("largest difference over the largest pressure: " << worst << ", bar 1e-12");
  CHECK(worst <= 1e-12);
}

}  // namespace rigid_exchange_tests
