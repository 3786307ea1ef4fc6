#pragma once
// One projection of liquid with rigid and elastic bodies: its input, its result, and the momentum exchanged.
#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "base/scene.h"
#include "coupling/report/measures.h"
#include "coupling/solids/kind_elastic.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/solids/rigid_coupling.h"
#include "coupling/solve/coupled_solve.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "grid/loops.h"
#include "scenes.h"

namespace seiche::test {

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

constexpr double dt = 0.01;

// Input and result of one projection.
template <int Dim>
struct Projection {
  Setup<Dim> setup;
  State<Dim> state;
  StepGeometry<Dim> geometry;
  FaceField<Dim> u_star;
  Participants<Dim> before;
  PressureRows<Dim> rows;
  SolidCoupling<Dim> coupling;

  // `deform` may first change the state of the elastic bodies. Without elastic bodies there is no contact.
  Projection(const Scene& scene, Filling filling, int seed, const std::function<void(ElasticState&)>& deform = {})
      : setup(scene, Communicator()), u_star(setup.domain.layout) {
    if (!setup.solids.plans_steps()) setup.solids.contact.reset();
    Dice dice{std::mt19937(unsigned(seed + 1000))};
    state.phi = CellField<Dim>(setup.domain.layout, -1);
    state.pressure = CellField<Dim>(setup.domain.layout);
    for_each_index_in_order(setup.domain.layout, setup.domain.layout.padded(), [&](Site c, const IVec<Dim>& i) {
      const Vec<Dim> x = setup.domain.layout.position(i, cell_offset<Dim>());
      if (filling == Filling::surface) state.phi[c] = x[1] - 0.71 + 0.1 * std::sin(7 * x[0]);
    });
    state.solids = setup.solids.at_start;
    for (std::size_t k = 0; k < state.solids.size(); ++k)
      if (ElasticMotion* motion = elastic_motion(state.solids[k])) deform(motion->state);
    before = state.solids;
    geometry = setup.solids.geometry.measure(place_bodies(state), 0);
    for (int a = 0; a < Dim; ++a)
      for (double& u : u_star[a]) u = dice(-1, 1);
    auto level = std::make_shared<TimeLevel<Dim>>(empty_level(setup.domain.layout, setup.fluids.is_viscous()));
    level->u = u_star;
    state.now = level;
    rows = number_rows(input());
    coupling = couple_solids(setup, geometry, rows, find_closed_components(input(), rows), state, dt, dt);
  }

  ProjectionInput<Dim> input() const {
    return {setup.domain.layout,
            setup.domain.halo,
            setup.domain.ranks,
            state.phi,
            geometry.faces,
            setup.fluids.density(),
            dt};
  }

  void solve() {
    const CellField<Dim> guess(setup.domain.layout);
    const FaceField<Dim> slope(setup.domain.layout);
    const ConvectedPressure<Dim> convected;
    const auto solution = solve_coupled(CoupledInput<Dim>{setup, input(), geometry, state, guess, slope, u_star, u_star,
                                                          convected, nullptr, dt, nullptr, PhaseFault::none});
    INFO(solution.failure << " " << fmt::format("{}", fmt::join(solution.report.failed_attempts, "; ")));
    REQUIRE(solution.failure.empty());
    state.pressure = solution.pressure;
  }

  Eigen::VectorXd velocities() const {
    Eigen::VectorXd v(coupling.target.size());
    for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
      const int k = coupling.bodies[b], first = coupling.first[b], n = coupling.first[b + 1] - first;
      v.segment(first, n) = state.solids[std::size_t(k)].velocity();
    }
    return v;
  }

  // Liquid fraction of the link between the centres on both sides of a face.
  double theta(int axis, Site f) const {
    const Site low = f - setup.domain.layout.stride(axis);
    if (geometry.faces.kind_at(axis, f) == FaceKind::outflow) return 0.5;
    if (rows.row[low] >= 0 && rows.row[f] >= 0) return 1;
    return rows.row[low] >= 0 ? surface_distance(state.phi[low], state.phi[f])
                              : surface_distance(state.phi[f], state.phi[low]);
  }

  // Calls visit(axis, face, position, mass rho w theta h^Dim) for the faces whose velocity the projection changes.
  template <class Visit>
  void for_each_unknown(const Visit& visit) const {
    const Layout<Dim>& l = setup.domain.layout;
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(l, l.faces(a), [&](Site f, const IVec<Dim>& i) {
        const bool wet = rows.row[f] >= 0 || rows.row[f - l.stride(a)] >= 0;
        if (!wet || !geometry.faces.is_unknown(a, f)) return;
        const double mass =
            setup.fluids.density() * l.geometry().cell_volume() * geometry.faces.open.at(a, f) * theta(a, f);
        visit(a, f, extend<Dim>(l.position(i, face_offset<Dim>(a))), mass);
      });
  }

  double velocity(int axis, Site f) const {
    return u_star.at(axis, f) - dt * face_pressure_slope(input(), rows, state.pressure, axis, f);
  }
};

// Linear momentum, and angular momentum about the origin.
struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  void add(const Vec3& at, const Vec3& p) {
    linear += p;
    angular += at.cross(p);
  }
};

inline Vec3 along(int axis, double value) {
  Vec3 v = Vec3::Zero();
  v[axis] = value;
  return v;
}

// Discrete balance between the velocities before gravity and after the solve. Each unknown face has m (u - u*) = -dt A
// w (p_high - p_low). Each body and static solid takes dt A s (p_low - p_high) at the centre of each face. w and the
// shares s of a face sum to one, so the total is -dt A sum_f (p_high - p_low). It telescopes along every row of cells
// to the terms at the sides of the domain: dt A w p_cell on walls, dt A w p_side on outflow sides. Torques telescope
// too: the two faces of a cell along an axis differ by h along that axis, which is no lever arm for a force along it.
template <int Dim>
struct Balance {
  Momentum change, gravity, correction, solids, sides;

  explicit Balance(const Projection<Dim>& p) {
    const Vec3 g = p.setup.fluids.gravity.at(0);
    p.for_each_unknown([&](int a, Site f, const Vec3& x, double m) {
      change.add(x, along(a, m * (p.velocity(a, f) - (p.u_star.at(a, f) - dt * g[a]))));
      gravity.add(x, along(a, m * dt * g[a]));
    });
    for (std::size_t b = 0; b < p.coupling.bodies.size(); ++b) {
      const int k = p.coupling.bodies[b];
      const double m = p.setup.solids.bodies[k].mass().mass;
      if (p.setup.solids.bodies[k].deforms()) {
        add_elastic(p, k, p.coupling.first[b]);
        continue;
      }
      const RigidState &now = *p.state.solids[std::size_t(k)].rigid(), &old = *p.before[std::size_t(k)].rigid();
      change.add(now.center, m * (now.velocity - old.velocity));
      change.angular += now.angular_momentum - old.angular_momentum;
      gravity.add(now.center, dt * m * g);
      const Twist extra = unstacked<Dim>(p.coupling.buoyancy_correction, p.coupling.first[b], now.center);
      correction.add(now.center, dt * extra.linear);
      correction.angular += dt * extra.angular;
    }
    const auto solids_now = measure_solids(p.setup, p.state, p.geometry);
    for (std::size_t k = 0; k < solids_now.size(); ++k) {
      if (p.state.solids[k].unknowns() > 0) continue;
      solids.add(solids_now[k].position, -dt * (solids_now[k].force - solids_now[k].unseen_force));
      solids.angular -= dt * (solids_now[k].torque - solids_now[k].unseen_torque);
    }
    add_sides(p);
  }

  // Linear momentum only: pressure acts at face centres, and the elastic forces balance in the configuration of the
  // solve.
  void add_elastic(const Projection<Dim>& p, int k, int first) {
    const ElasticBody<Dim>& body = p.setup.solids.bodies[k].elastic().body;
    const Eigen::VectorXd w = p.state.solids[std::size_t(k)].velocity();
    const Eigen::VectorXd dv = w - elastic_motions(p.before)[std::size_t(k)]->state.v, momentum = body.mass * dv;
    for (int n = 0; n < int(momentum.size()); ++n) change.linear[n % Dim] += momentum[n];
    for (int n = 0; n < int(w.size()); ++n) {
      change.linear[n % Dim] += p.coupling.mass_beside[first + n] * w[n] - p.coupling.momentum_beside[first + n];
      correction.linear[n % Dim] += dt * p.coupling.buoyancy_correction[first + n];
    }
    gravity.linear += dt * p.setup.solids.bodies[k].mass().mass * p.setup.fluids.gravity.at(0);
  }

  void add_sides(const Projection<Dim>& p) {
    const Layout<Dim>& l = p.setup.domain.layout;
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

// Compares the flux J v out of each cell, as the liquid's geometry has it, with J' of the bodies' force. Returns the
// relative difference.
template <int Dim>
double adjointness_error(Projection<Dim>& p) {
  Dice dice{std::mt19937(3)};
  Eigen::VectorXd v(p.coupling.target.size());
  for (double& x : v) x = dice(-1, 1);
  Vector pressure(p.rows.cells.size());
  for (double& x : pressure) x = dice(-1, 1);
  const double forces = v.dot(multiply_transposed(p.coupling.J, pressure, p.setup.domain.ranks));
  for (std::size_t b = 0; b < p.coupling.bodies.size(); ++b) {
    const int k = p.coupling.bodies[b], first = p.coupling.first[b], n = p.coupling.first[b + 1] - first;
    if (p.setup.solids.bodies[k].deforms()) {
      p.geometry.cell_fluxes[std::size_t(k)] = p.coupling.cell_fluxes[b];
      set_node_velocity(p.setup.domain.layout, k, v.segment(first, n), p.geometry);
      continue;
    }
    set_twist(p.setup.domain.layout, k, Twist{}, p.geometry);
    set_twist(p.setup.domain.layout, k, unstacked<Dim>(v, first, p.state.solids[std::size_t(k)].rigid()->center),
              p.geometry);
  }
  double fluxes = 0, size = 0;
  for (std::size_t n = 0; n < pressure.size(); ++n) {
    fluxes += pressure[n] * p.geometry.faces.cell_flux[p.rows.cells[n]];
    for_each_face_of(p.setup.domain.layout, p.rows.cells[n], [&](int a, Site f, int sign, Site) {
      fluxes += sign * pressure[n] * p.geometry.faces.closed_flux.at(a, f);
      size += std::abs(pressure[n] * p.geometry.faces.closed_flux.at(a, f));
    });
  }
  return std::abs(fluxes - forces) / size;
}

// Calls check() for projections in 2D and 3D of scenes made for a dimension, a filling and a seed. Elastic nodes are
// displaced by up to `far` (m).
template <class Check>
void for_random_projections(Scene (*make)(int, Filling, int), double far, const Check& check) {
  for (const Filling filling : {Filling::closed, Filling::surface, Filling::outflow})
    for (int seed = 0; seed < 4; ++seed) {
      Dice dice{std::mt19937(unsigned(seed + 2000))};
      const auto deform = [&](ElasticState& e) {
        for (double& u : e.u) u = dice(-far, far);
        for (double& v : e.v) v += dice(-0.1, 0.1);
      };
      check(Projection<2>(make(2, filling, seed), filling, seed, deform));
      check(Projection<3>(make(3, filling, seed), filling, seed, deform));
    }
}

}  // namespace seiche::test
