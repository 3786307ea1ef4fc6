// What one projection passes between liquid, rigid bodies, static solids and walls, on random scenes.
#include <catch2/catch.hpp>
#include <random>

#include "coupling/coupled_solve.h"
#include "coupling/measures.h"
#include "grid/loops.h"
#include "scenes.h"

using namespace seiche;

namespace {

enum class Filling { closed, surface, outflow };

struct Dice {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vec3 vector(int dim, double low, double high) {
    Vec3 v = Vec3::Zero();
    for (int a = 0; a < dim; ++a) v[a] = (*this)(low, high);
    return v;
  }
};

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

// Four rigid bodies and two static solids wherever they fall: across walls, the surface and each other.
Scene random_scene(int dim, Filling filling, double tolerance, int seed) {
  Scene s = test::box_scene(dim, dim == 2 ? 19 : 11);
  Dice dice{std::mt19937(unsigned(seed))};
  s.gravity = dice.vector(dim, -10, 10);
  s.solver.tolerance = tolerance;
  for (int k = 0; k < 6; ++k) s.solids.push_back(random_solid(dice, dim, k));
  if (filling == Filling::outflow) s.domain.sides[0][1] = {SideType::outflow, {"0", "0", "0"}, "300"};
  return s;
}

constexpr double dt = 0.01;

// One projection: what went in, what came out.
template <int Dim>
struct Projection {
  Setup<Dim> setup;
  State<Dim> state;
  StepGeometry<Dim> geometry;
  FaceField<Dim> u_star;
  std::vector<RigidState> before;
  PressureRows<Dim> rows;
  SolidCoupling<Dim> coupling;

  Projection(const Scene& scene, Filling filling, int seed) : setup(scene, Communicator()), u_star(setup.layout) {
    setup.contact.reset();
    Dice dice{std::mt19937(unsigned(seed + 1000))};
    state.phi = CellField<Dim>(setup.layout, -1);
    state.pressure = CellField<Dim>(setup.layout);
    for_each_index_in_order(setup.layout, setup.layout.padded(), [&](Site c, const IVec<Dim>& i) {
      const Vec<Dim> x = setup.layout.position(i, cell_offset<Dim>());
      if (filling == Filling::surface) state.phi[c] = x[1] - 0.71 + 0.1 * std::sin(7 * x[0]);
    });
    for (const Body<Dim>& body : setup.bodies) {
      state.rigid.push_back(initial_rigid_state(body));
      state.elastic.push_back(initial_elastic_motion(body));
    }
    before = state.rigid;
    geometry = setup.solids.measure(place_bodies(setup, state), 0);
    for (int a = 0; a < Dim; ++a)
      for (double& u : u_star[a]) u = dice(-1, 1);
    rows = number_rows(input());
    coupling = couple_solids(setup, geometry, rows, state, dt, dt);
  }

  ProjectionInput<Dim> input() const {
    return {setup.layout, setup.halo, setup.ranks, state.phi, geometry.faces, setup.density(), dt};
  }

  void solve() {
    const auto solution =
        solve_coupled(setup, input(), geometry, state, CellField<Dim>(setup.layout), u_star, dt, PhaseFault::none);
    INFO(solution.failure << " " << fmt::format("{}", fmt::join(solution.report.ladder, "; ")));
    REQUIRE(solution.failure.empty());
    state.pressure = solution.pressure;
  }

  Eigen::VectorXd velocities() const {
    Eigen::VectorXd v(coupling.target.size());
    for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
      const RigidState& r = state.rigid[coupling.bodies[b]];
      v.segment<twist_size<Dim>>(twist_size<Dim> * int(b)) = stacked<Dim>(r.velocity, r.angular_velocity);
    }
    return v;
  }

  // Share of the link between the centres beside a face that is liquid.
  double theta(int axis, Site f) const {
    const Site low = f - setup.layout.stride(axis);
    if (geometry.faces.kind_at(axis, f) == FaceKind::outflow) return 0.5;
    if (rows.row[low] >= 0 && rows.row[f] >= 0) return 1;
    return rows.row[low] >= 0 ? surface_distance(state.phi[low], state.phi[f])
                              : surface_distance(state.phi[f], state.phi[low]);
  }

  // visit(axis, face, position, mass rho w theta h^Dim) of the faces whose velocity the projection changes.
  template <class Visit>
  void for_each_unknown(const Visit& visit) const {
    const Layout<Dim>& l = setup.layout;
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(l, l.faces(a), [&](Site f, const IVec<Dim>& i) {
        const bool wet = rows.row[f] >= 0 || rows.row[f - l.stride(a)] >= 0;
        if (!wet || !geometry.faces.is_unknown(a, f)) return;
        const double mass = setup.density() * l.geometry().cell_volume() * geometry.faces.open.at(a, f) * theta(a, f);
        visit(a, f, extend<Dim>(l.position(i, face_offset<Dim>(a))), mass);
      });
  }

  double velocity(int axis, Site f) const {
    return u_star.at(axis, f) - dt * face_pressure_slope(input(), rows, state.pressure, axis, f);
  }
};

template <class Check>
void for_random_projections(std::initializer_list<Filling> fillings, double tolerance, const Check& check) {
  for (const Filling filling : fillings)
    for (int seed = 0; seed < 5; ++seed) {
      check(Projection<2>(random_scene(2, filling, tolerance, seed), filling, seed));
      check(Projection<3>(random_scene(3, filling, tolerance, seed), filling, seed));
    }
}

// Momentum and, about the origin, angular momentum.
struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  void add(const Vec3& at, const Vec3& p) {
    linear += p;
    angular += at.cross(p);
  }
};

Vec3 along(int axis, double value) {
  Vec3 v = Vec3::Zero();
  v[axis] = value;
  return v;
}

// The discrete balance of the velocities before gravity and after the solve. Each unknown face has m (u - u*) = -dt A w
// (p_high - p_low), each body and static solid takes dt A s (p_low - p_high) of each face at the face's centre, and w
// and the shares s of a face sum to one. So all of it sums to -dt A sum_f (p_high - p_low), which telescopes along
// every row of cells to what acts on the sides of the domain: dt A w p_cell on walls, dt A w p_side on outflow sides.
// Torques too: the two faces of a cell across an axis differ by h along that axis, which is no arm for a force along
// it.
template <int Dim>
struct Balance {
  Momentum change, gravity, correction, solids, sides;

  explicit Balance(const Projection<Dim>& p) {
    const Vec3 g = p.setup.gravity.at(0);
    p.for_each_unknown([&](int a, Site f, const Vec3& x, double m) {
      change.add(x, along(a, m * (p.velocity(a, f) - (p.u_star.at(a, f) - dt * g[a]))));
      gravity.add(x, along(a, m * dt * g[a]));
    });
    for (std::size_t b = 0; b < p.coupling.bodies.size(); ++b) {
      const int k = p.coupling.bodies[b];
      const double m = p.setup.bodies[k].mass().mass;
      const RigidState &now = p.state.rigid[k], &old = p.before[k];
      change.add(now.center, m * (now.velocity - old.velocity));
      change.angular += now.angular_momentum - old.angular_momentum;
      gravity.add(now.center, dt * m * g);
      const Twist extra = unstacked<Dim>(p.coupling.buoyancy_correction, twist_size<Dim> * int(b), now.center);
      correction.add(now.center, dt * extra.linear);
      correction.angular += dt * extra.angular;
    }
    const auto solids_now = measure_solids(p.setup, p.state, p.geometry);
    for (std::size_t k = 0; k < solids_now.size(); ++k) {
      if (p.setup.bodies[k].is_rigid()) continue;
      solids.add(solids_now[k].position, -dt * solids_now[k].force);
      solids.angular -= dt * solids_now[k].torque;
    }
    add_sides(p);
  }

  void add_sides(const Projection<Dim>& p) {
    const Layout<Dim>& l = p.setup.layout;
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(l, l.faces(a), [&](Site f, const IVec<Dim>& i) {
        if (i[a] != 0 && i[a] != l.geometry().cells[a]) return;
        const Site inside = i[a] == 0 ? f : f - l.stride(a);
        if (p.rows.row[inside] < 0) return;
        const FaceKind kind = p.geometry.faces.kind_at(a, f);
        const double pressure =
            kind == FaceKind::outflow ? p.geometry.faces.side_pressure.at(a, f) : p.state.pressure[inside];
        const double impulse = dt * l.geometry().face_area() * p.geometry.faces.open.at(a, f) * pressure;
        sides.add(extend<Dim>(l.position(i, face_offset<Dim>(a))), along(a, i[a] == 0 ? impulse : -impulse));
      });
  }

  double error(Vec3 Momentum::*part) const {
    const Vec3 rest = change.*part - gravity.*part - correction.*part - solids.*part - sides.*part;
    double largest = 0;
    for (const Momentum* m : {&change, &gravity, &correction, &solids, &sides})
      largest = std::max(largest, (m->*part).cwiseAbs().maxCoeff());
    return rest.cwiseAbs().maxCoeff() / largest;
  }
};

// The flux J v out of each cell as the geometry has it for the liquid, against J of the bodies' force.
template <int Dim>
double adjointness_error(Projection<Dim>& p) {
  Dice dice{std::mt19937(3)};
  Eigen::VectorXd v(p.coupling.target.size());
  for (double& x : v) x = dice(-1, 1);
  Vector pressure(p.rows.cells.size());
  for (double& x : pressure) x = dice(-1, 1);
  const double forces = v.dot(multiply_transposed(p.coupling.J, pressure, p.setup.ranks));
  for (int k : p.coupling.bodies) set_twist(p.setup.layout, k, Twist{}, p.geometry);
  for (std::size_t b = 0; b < p.coupling.bodies.size(); ++b) {
    const int k = p.coupling.bodies[b];
    set_twist(p.setup.layout, k, unstacked<Dim>(v, twist_size<Dim> * int(b), p.state.rigid[k].center), p.geometry);
  }
  double fluxes = 0, size = 0;
  for (std::size_t n = 0; n < pressure.size(); ++n)
    for_each_face_of(p.setup.layout, p.rows.cells[n], [&](int a, Site f, int sign, Site) {
      fluxes += sign * pressure[n] * p.geometry.faces.closed_flux.at(a, f);
      size += std::abs(pressure[n] * p.geometry.faces.closed_flux.at(a, f));
    });
  return std::abs(fluxes - forces) / size;
}

// 1/2 sum m u^2 + 1/2 v'Mv.
template <int Dim, class Velocity>
double kinetic_energy(const Projection<Dim>& p, const Eigen::VectorXd& v, const Velocity& u) {
  double sum = 0.5 * v.dot(p.coupling.mass * v);
  p.for_each_unknown([&](int a, Site f, const Vec3&, double m) { sum += 0.5 * m * std::pow(u(a, f), 2); });
  return sum;
}

// The pressures of [A, c1 J; -c2 J', M] (p, v) = (b, M v*), by dense elimination.
template <int Dim>
Eigen::VectorXd saddle_pressures(const Projection<Dim>& p) {
  const ProjectionInput<Dim> in = p.input();
  const double h = p.setup.layout.h(), c1 = p.setup.density() * h / dt, c2 = dt * std::pow(h, Dim - 1);
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
  // Rows in units of their diagonal: densities differ by 1e10.
  const Eigen::VectorXd scale = K.diagonal().cwiseInverse();
  return (scale.asDiagonal() * K).partialPivLu().solve(scale.cwiseProduct(right)).head(n);
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
  // The two parts are orthogonal as far as the solve goes: 1e-12 of the fluxes.
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
