#include "coupling/solve/viscous_solve.h"

#include <fmt/format.h>

#include <memory>

#include "base/scene.h"
#include "coupling/solids/joint_bow.h"
#include "coupling/solve/viscous_problem.h"
#include "coupling/state/setup.h"
#include "grid/loops.h"
#include "levelset/extrapolate.h"

namespace seiche {
namespace {

// Saddle-point solver of the liquid and the bodies that G and J couple to it (empty: none). D M^-1 D' = h^(Dim-2)/rho
// A.
template <int Dim>
SaddleSolver make_solver(const CoupledInput<Dim>& in, const PressureProblem<Dim>& liquid, const ViscousSystem<Dim>& v,
                         const BlockColumns& G, const BlockColumns& J) {
  const Layout<Dim>& layout = in.liquid.layout;
  std::vector<int> axes;  // of each row of F
  std::vector<std::array<double, 3>> positions;
  for (const auto& [axis, face] : v.rows.faces) {
    const Vec<Dim> x = layout.position(layout.index(face), face_offset<Dim>(axis)) / layout.h();
    axes.push_back(axis);
    std::copy_n(x.data(), Dim, positions.emplace_back().begin());
  }
  const double schur_scale = std::pow(layout.h(), Dim - 2) / in.liquid.density;
  return SaddleSolver({.F = v.F,
                       .G = G,
                       .D = v.D,
                       .Dt = v.Dt,
                       .J = J,
                       .A = liquid.A,
                       .grid = liquid.grid,
                       .closed = liquid.closed,
                       .schur_scale = schur_scale,
                       .schur_mass = v.schur_mass,
                       .mass = v.mass,
                       .axis = std::move(axes),
                       .position = std::move(positions)},
                      {.tolerance = liquid_tolerance(in)}, in.setup.domain.ranks);
}

// u + by * slope on faces with an unknown velocity. Ghosts filled.
template <int Dim>
FaceField<Dim> shifted(const CoupledInput<Dim>& in, const FaceField<Dim>& u, double by) {
  FaceField<Dim> r = u;
  for (int a = 0; a < Dim; ++a)
    for_each_site(in.liquid.layout, in.liquid.layout.faces(a), [&](Site f) {
      if (in.liquid.faces.is_unknown(a, f)) r.at(a, f) += by * in.slope.at(a, f);
    });
  fill_velocity_ghosts(in.liquid.layout, in.liquid.halo, in.setup.domain.sides, r);
  return r;
}

// u += by * grad p/rho of the solution on faces with an unknown velocity. Fills ghosts.
template <int Dim>
void add_pressure(const CoupledInput<Dim>& in, const CoupledSolution<Dim>& r, double by, FaceField<Dim>& u) {
  const Layout<Dim>& layout = in.liquid.layout;
  for (int a = 0; a < Dim; ++a)
    for_each_site(layout, layout.faces(a), [&](Site f) {
      if (in.liquid.faces.is_unknown(a, f)) u.at(a, f) += by * face_pressure_slope(in.liquid, r.rows, r.pressure, a, f);
    });
  fill_velocity_ghosts(layout, in.liquid.halo, in.setup.domain.sides, u);
}

// True if the pressure acts on the face. Other faces of unknown velocity only follow the stress (face_mass in
// fluid/viscosity/viscosity.cpp).
template <int Dim>
bool feels_pressure(const CoupledInput<Dim>& in, const PressureRows<Dim>& rows, int axis, Site f) {
  return in.liquid.faces.is_unknown(axis, f) && in.liquid.faces.open.at(axis, f) > 0 &&
         rows.touch_pressure(f - in.liquid.layout.stride(axis), f);
}

// One component of u, continued from the faces that feel the pressure. known: 1 there, 0 where nothing reaches.
template <int Dim>
struct ContinuedComponent {
  FieldValues<double> value;
  FieldValues<char> known;
};

// Over two layers, of which `straight` linearly. Collective.
template <int Dim>
ContinuedComponent<Dim> continue_component(const CoupledInput<Dim>& in, const PressureRows<Dim>& rows, int axis,
                                           const FaceField<Dim>& u, int straight) {
  const Layout<Dim>& layout = in.liquid.layout;
  ContinuedComponent<Dim> r{u[axis], FieldValues<char>(std::size_t(layout.size()))};
  for_each_site(layout, layout.faces(axis), [&](Site f) { r.known[f] = feels_pressure(in, rows, axis, f); });
  extrapolate(layout, in.liquid.halo, layout.faces(axis), {2, straight}, r.value, r.known);
  return r;
}

// Faces that only follow the stress take the velocity of those beside them that feel the pressure. With weight and no
// pressure they would fall, and pull the liquid down. Beyond the surface it is constant. In free-slip solids it keeps
// its slope: liquid that turns with its solid has no stress. Closed faces far from such faces keep the velocity before
// the step. Ghosts filled. Collective.
template <int Dim>
FaceField<Dim> with_followers(const CoupledInput<Dim>& in, const PressureRows<Dim>& rows, FaceField<Dim> u) {
  const Layout<Dim>& layout = in.liquid.layout;
  const bool any_solid = !in.setup.solids.bodies.empty();
  for (int a = 0; a < Dim; ++a) {
    const ContinuedComponent<Dim> flat = continue_component(in, rows, a, u, 0);
    const ContinuedComponent<Dim> straight = any_solid ? continue_component(in, rows, a, u, 2) : flat;
    for_each_site(layout, layout.faces(a), [&](Site f) {
      const FaceKind kind = in.liquid.faces.kind_at(a, f);
      if (flat.known[f] == 1 || kind == FaceKind::prescribed) return;
      const bool closed = kind == FaceKind::closed;
      if (flat.known[f] > 1)
        u.at(a, f) = closed ? straight.value[f] : flat.value[f];
      else if (closed)
        u.at(a, f) = in.flow.at(a, f);
    });
  }
  fill_velocity_ghosts(layout, in.liquid.halo, in.setup.domain.sides, u);
  return u;
}

// u*, on those faces the velocity beside them with the pressure of the last step. Ghosts filled. Collective.
template <int Dim>
FaceField<Dim> with_pressed_followers(const CoupledInput<Dim>& in, const PressureRows<Dim>& rows) {
  FaceField<Dim> u = with_followers(in, rows, shifted(in, in.u_star, -in.liquid.dt));
  const Layout<Dim>& layout = in.liquid.layout;
  for (int a = 0; a < Dim; ++a)
    for_each_site(layout, layout.faces(a), [&](Site f) {
      if (feels_pressure(in, rows, a, f)) u.at(a, f) = in.u_star.at(a, f);
    });
  fill_velocity_ghosts(layout, in.liquid.halo, in.setup.domain.sides, u);
  return u;
}

template <int Dim>
ProjectionInput<Dim> with_faces(const ProjectionInput<Dim>& p, const FaceGeometry<Dim>& faces) {
  return {p.layout, p.halo, p.ranks, p.phi, faces, p.density, p.dt, p.separation, p.gas_density, nullptr, p.air};
}

template <int Dim>
FaceGeometry<Dim> without_side_pressures(FaceGeometry<Dim> faces) {
  faces.side_pressure.fill(0);
  return faces;
}

template <int Dim>
void add_wall_flux(const CoupledInput<Dim>& in, ViscousStep<Dim>& viscous) {
  PagedFaceField<Dim>& closed_flux = in.geometry.faces.closed_flux;
  if (in.at_walls) return viscous.add_wall_flux(in.at_walls->flow->u, in.at_walls->motion, closed_flux);
  viscous.add_wall_flux(in.flow, motions_at_walls(in.state.solids, in.geometry), closed_flux);
}

// Impulse of the drag of the velocities u on the unknowns of the solids over the step, N s, the same on all ranks.
template <int Dim>
Eigen::VectorXd drag_on_solids(const ViscousStep<Dim>& viscous, const Vector& u, const Communicator& ranks) {
  Eigen::VectorXd drag = multiply_transposed(viscous.system().G, u, ranks);
  drag += multiply_transposed(viscous.G_held(), u, ranks);
  make_identical(drag, ranks);
  return drag;
}

// With v = w + the part that the joints prescribe, C w = 0. Collective.
template <int Dim>
SaddleReport solve_with_joints(SaddleSolver& solver, const BodyMatrix& H, const ViscousSystem<Dim>& system,
                               const JointMotion<Dim>& joints, const Eigen::VectorXd& push, Vector& u,
                               Eigen::VectorXd& v) {
  const Eigen::VectorXd part = H.prescribed(joints.rate), none = Eigen::VectorXd::Zero(joints.rate.size());
  Vector f = system.f;
  add_multiplied(system.G, -part, f);
  const Eigen::VectorXd g = H.constraints().without_multipliers(push - H.multiply(part));
  Eigen::VectorXd w = H.constraints().moved_onto(v - part, none);
  const SaddleReport report = solver.solve_viscous(H, f, g, u, w);
  v = w + part;
  return report;
}

}  // namespace

template <int Dim>
SplitViscosity<Dim>::SplitViscosity(const CoupledInput<Dim>& in, const SolidCoupling<Dim>& coupling,
                                    const CoupledSolution<Dim>& r)
    : in_(in),
      faces_(without_side_pressures(in.liquid.faces)),
      unpressed_(with_faces(in.liquid, faces_)),
      pressed_(with_followers(in, r.rows, shifted(in, in.u_star, -in.liquid.dt))),
      viscous_(in.setup.domain, in.setup.solids, unpressed_, r.rows, in.geometry, in.state, coupling, *in.viscosity,
               pressed_) {
  add_wall_flux(in, viscous_);
}

template <int Dim>
void SplitViscosity<Dim>::act(const PressureProblem<Dim>& liquid, SolidCoupling<Dim>& coupling,
                              CoupledSolution<Dim>& r) {
  const CoupledInput<Dim>& in = in_;
  const double dt = in.liquid.dt;
  const ViscousSystem<Dim>& system = viscous_.system();
  SaddleSolver solver = make_solver(in, liquid, system, system.G, viscous_.J());
  Vector p = guessed_pressure(in, r.rows), u = viscous_.gather(pressed_);
  Eigen::VectorXd impulse = dt * multiply_transposed(viscous_.J(), p, in.setup.domain.ranks);
  make_identical(impulse, in.setup.domain.ranks);
  Eigen::VectorXd push = push_with_bow(coupling) + impulse + system.g, v = coupling.free;
  BodyMatrix H(in.setup.domain.ranks);
  if (!H.set(uncouple_held(coupling, coupling.mass + system.Hvv, push), coupling.J.constraints)) {
    r.failure = "the matrix of the solids' inertia and drag is not positive definite";
    return;
  }
  const SaddleReport report = coupling.is_constrained()
                                  ? solve_with_joints(solver, H, system, *coupling.joints, push, u, v)
                                  : solver.solve_viscous(H, system.f, push, u, v);
  r.report.iterations = report.iterations;
  r.report.failed_attempts = report.failed_attempts;
  if (!report.converged) {
    r.failure = fmt::format("the solve of viscosity stopped at residual {:.2e} after {} iterations", report.residual,
                            report.iterations);
    return;
  }
  coupling.push += system.g - system.Hvv * v - drag_on_solids(viscous_, u, in.setup.domain.ranks);
  FaceField<Dim> moved = pressed_;
  viscous_.scatter(u, moved);
  fill_velocity_ghosts(in.liquid.layout, in.liquid.halo, in.setup.domain.sides, moved);
  r.u_star = shifted(in, moved, dt);
  r.solids = v;
  r.viscous_loads = viscous_.loads(moved, v);
  viscous_.keep_samples_only();
  solids_ = v;
  solids_before_ = velocities_in(coupling, in.state);
}

// u = u* - dt grad p/rho. The stress is that of u* without the pressure of the last step.
template <int Dim>
void SplitViscosity<Dim>::measure(CoupledSolution<Dim>& r) const {
  FaceField<Dim> u = r.u_star;
  add_pressure(in_, r, -in_.liquid.dt, u);
  r.viscous =
      viscous_.power({shifted(in_, r.u_star, -in_.liquid.dt), solids_}, {u, r.solids}, {in_.flow, solids_before_});
}

template <int Dim>
void solve_with_viscosity(const CoupledInput<Dim>& in, const PressureProblem<Dim>& liquid, SolidCoupling<Dim>& coupling,
                          CoupledSolution<Dim>& r) {
  const Setup<Dim>& s = in.setup;
  const double dt = in.liquid.dt;
  const FaceField<Dim> u_star = with_pressed_followers(in, r.rows);
  ViscousStep<Dim> viscous(s.domain, s.solids, in.liquid, r.rows, in.geometry, in.state, coupling, *in.viscosity,
                           u_star);
  add_wall_flux(in, viscous);
  const BlockColumns none;
  SaddleSolver solver = make_solver(in, liquid, viscous.system(), viscous.system().G, viscous.J());
  std::unique_ptr<SaddleSolver> alone;
  const auto make_alone = [&]() -> SaddleSolver& {
    if (!alone) alone.reset(new SaddleSolver(make_solver(in, liquid, viscous.system(), none, none)));
    return *alone;
  };
  refuse_impossible_motion(in, liquid, coupling, solver.sensed_components(), r);
  Vector u = viscous.gather(u_star), p = guessed_pressure(in, r.rows);
  for (double& x : p) x *= -dt;
  ViscousProblem<Dim> problem(coupling, viscous, {solver, make_alone}, s.domain.layout.geometry().face_area(),
                              liquid.closed, u, p, s.domain.ranks);
  r.solids = find_minimum(in, coupling, problem, {}, r);
  refuse_unbalanced_chambers(in, liquid, solver.sensed_components(), r);
  for (double& x : p) x /= -dt;
  set_pressure(in, p, r);
  FaceField<Dim> solved = u_star;
  viscous.scatter(u, solved);
  fill_velocity_ghosts(s.domain.layout, s.domain.halo, s.domain.sides, solved);
  if (!r.failure.empty()) return;
  r.viscous_loads = viscous.loads(solved, r.solids);
  r.viscous = viscous.power({solved, r.solids}, {solved, r.solids}, {in.flow, velocities_in(coupling, in.state)});
  r.u_star = std::move(solved);
  add_pressure(in, r, dt, r.u_star);
}

#define SEICHE_INSTANTIATE(D)                                                                                 \
  template class SplitViscosity<D>;                                                                           \
  template void solve_with_viscosity<D>(const CoupledInput<D>&, const PressureProblem<D>&, SolidCoupling<D>&, \
                                        CoupledSolution<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
