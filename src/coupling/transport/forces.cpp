#include "coupling/transport/forces.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/sponges.h"
#include "coupling/transport/transport.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

// Velocity at a face: its own component, and means of the four nearest faces of the other axes.
template <int Dim>
Vec3 velocity_at_face(const Layout<Dim>& l, const FaceField<Dim>& u, int axis, Site f) {
  Vec3 v = Vec3::Zero();
  v[axis] = u.at(axis, f);
  for (int b = 0; b < Dim; ++b) {
    if (b == axis) continue;
    const Site below = f - l.stride(axis);
    v[b] = 0.25 * (u.at(b, f) + u.at(b, f + l.stride(b)) + u.at(b, below) + u.at(b, below + l.stride(b)));
  }
  return v;
}

// grad(phi) at a face, of unit length; zero where there is none.
template <int Dim>
Vec3 normal_at_face(const Layout<Dim>& l, const CellField<Dim>& phi, int axis, Site f) {
  const Site below = f - l.stride(axis);
  Vec3 n = Vec3::Zero();
  n[axis] = phi[f] - phi[below];
  for (int b = 0; b < Dim; ++b)
    if (b != axis)
      n[b] = 0.25 * (phi[f + l.stride(b)] - phi[f - l.stride(b)] + phi[below + l.stride(b)] - phi[below - l.stride(b)]);
  return n.norm() > 0 ? Vec3(n.normalized()) : n;
}

// One step of all forces at the faces of the grid.
template <int Dim>
class ForcesAtFaces {
 public:
  ForcesAtFaces(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, double t, double dt)
      : l_(domain.layout), fluids_(fluids), phi_(phi), t_(t), dt_(dt) {}

  // Mean acceleration over the step of liquid that has the velocity `u` at the face, m/s^2.
  double acceleration(const Force<Dim>& force, const FaceField<Dim>& u, const Vec3& gravity, int axis, Site f,
                      const Vec3& x) const {
    const double middle = t_ - 0.5 * dt_;
    if (!force.acts_at(x)) return 0;
    if (force.is_field()) return force.field_at(x, middle)[axis];
    if (force.spec.kind == ForceKind::wind) return wind(force, u, axis, f, x);
    const double rate = force.rate(x, middle), w = force.velocity.component(axis, x, middle);
    if (!(rate >= 0)) return std::numeric_limits<double>::quiet_NaN();
    return -std::expm1(-rate * dt_) / dt_ * (dt_ * gravity[axis] + w - u.at(axis, f));
  }

  // Distance to the surface, m, negative in the liquid.
  double depth(int axis, Site f) const { return 0.5 * (phi_[f] + phi_[f - l_.stride(axis)]); }

 private:
  double wind(const Force<Dim>& force, const FaceField<Dim>& u, int axis, Site f, const Vec3& x) const {
    const double d = depth(axis, f);
    if (d > 0 || d <= -l_.h()) return 0;
    const Vec3 n = normal_at_face(l_, phi_, axis, f),
               relative = force.velocity(x, t_ - 0.5 * dt_) - velocity_at_face(l_, u, axis, f),
               along = relative - n.dot(relative) * n;
    const double layer = 0.5 * l_.h() - d;  // from the surface to the bottom of the cell: what moves with this face
    const double rate = force.spec.surface_drag * force.spec.air_density * along.norm() / (fluids_.density() * layer);
    return rate / (1 + rate * dt_) * along[axis];
  }

  const Layout<Dim>& l_;
  const Fluids& fluids_;
  const CellField<Dim>& phi_;
  double t_, dt_;
};

std::string fault_of_force(const ForceSpec& spec, const Vec3& x, double t) {
  return fmt::format("{}: force \"{}\" is not finite, or its rate is negative, at ({:g}, {:g}, {:g}) and t = {:g} s",
                     spec.where, spec.name, x[0], x[1], x[2], t);
}

// visit(axis, face, x) for owned faces within two cells of liquid; with gas that flows, for all.
template <int Dim, class Visit>
void for_each_face_near_liquid(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi,
                               const Visit& visit) {
  const Layout<Dim>& l = domain.layout;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(l, l.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (fluids.gas.flows() || std::min(phi[f], phi[f - l.stride(a)]) < 2 * l.h())
        visit(a, f, extend<Dim>(l.position(i, face_offset<Dim>(a))));
    });
}

template <int Dim>
void apply_forces(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Force<Dim>>& forces,
                  const CellField<Dim>& phi, const Vec3& gravity, double t, double dt, FaceField<Dim>& u) {
  const ForcesAtFaces<Dim> at(domain, fluids, phi, t, dt);
  std::string fault;
  for (const Force<Dim>& force : forces) {
    if (!force.acts_on_liquid()) continue;
    const FaceField<Dim> before = u;
    for_each_face_near_liquid(domain, fluids, phi, [&](int a, Site f, const Vec3& x) {
      const double gain = dt * at.acceleration(force, before, gravity, a, f, x);
      if (!std::isfinite(gain) && fault.empty()) fault = fault_of_force(force.spec, x, t - 0.5 * dt);
      u.at(a, f) += gain;
    });
    fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, u);
  }
  if (!domain.ranks.any(!fault.empty())) return;
  for (const std::string& text : domain.ranks.all_gather(fault))
    if (!text.empty()) throw Error(ExitCode::cannot_continue, text);
}

}  // namespace

template <int Dim>
void act_on_liquid(const Setup<Dim>& s, const CellField<Dim>& phi, double t, double dt, FaceField<Dim>& u) {
  const Vec3 gravity = s.perturbation.gravity * s.fluids.gravity.of_step(t, dt);
  if (!s.sponges.empty()) absorb(s.domain, s.sponges, gravity, t, dt, u);
  if (!s.forces.empty()) apply_forces(s.domain, s.fluids, s.forces, phi, gravity, t, dt, u);
}

template <int Dim>
double work_of_forces(const Setup<Dim>& s, const State<Dim>& before, const Attempt<Dim>& a) {
  const double dt = a.state.time - before.time;
  const ForcesAtFaces<Dim> at(s.domain, s.fluids, a.state.phi, a.state.time, dt);
  double sum = 0;
  for_each_face_near_liquid(s.domain, s.fluids, a.state.phi, [&](int axis, Site f, const Vec3& x) {
    const Site below = f - s.domain.layout.stride(axis);
    const double share = 0.5 * (liquid_share(s.domain.layout, a.state.phi, a.geometry.psi, f) +
                                liquid_share(s.domain.layout, a.state.phi, a.geometry.psi, below));
    if (share <= 0) return;
    const double was = before.now->u.at(axis, f), u = 0.5 * (was + a.state.now->u.at(axis, f));
    for (const Force<Dim>& force : s.forces)
      if (force.acts_on_liquid()) sum += share * u * at.acceleration(force, before.now->u, Vec3::Zero(), axis, f, x);
    for (const Sponge& sponge : s.sponges) {
      const double drawn = -std::expm1(-sponge.rate_at(x, a.state.time) * dt) / dt;
      if (drawn != 0) sum += share * u * drawn * (sponge.velocity_at(axis, x, a.state.time) - was);
    }
  });
  return dt * s.fluids.density() * s.domain.layout.geometry().cell_volume() * s.domain.ranks.global_sum(sum);
}

template <int Dim>
double fastest_dragged(const Domain<Dim>& domain, const std::vector<Force<Dim>>& forces, double t, double dt) {
  constexpr int points = 17;
  const Geometry<Dim>& g = domain.layout.geometry();
  double fastest = 0;
  for (const Force<Dim>& force : forces) {
    if (force.spec.kind != ForceKind::drag) continue;
    for (int n = 0; n < (Dim == 2 ? points * points : points * points * points); ++n) {
      Vec<Dim> x;
      for (int a = 0, rest = n; a < Dim; ++a, rest /= points)
        x[a] = g.lower[a] + g.h * g.cells[a] * (rest % points) / (points - 1);
      const double part = -std::expm1(-force.rate(extend<Dim>(x), t) * dt),
                   speed = part * force.velocity(extend<Dim>(x), t).norm();
      if (std::isfinite(speed)) fastest = std::max(fastest, speed);
    }
  }
  return fastest;
}

#define SEICHE_INSTANTIATE(D)                                                                          \
  template void act_on_liquid<D>(const Setup<D>&, const CellField<D>&, double, double, FaceField<D>&); \
  template double work_of_forces<D>(const Setup<D>&, const State<D>&, const Attempt<D>&);              \
  template double fastest_dragged<D>(const Domain<D>&, const std::vector<Force<D>>&, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
