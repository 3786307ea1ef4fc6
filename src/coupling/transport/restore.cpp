#include "coupling/transport/restore.h"

#include <optional>
#include <unordered_map>

#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/thin/gap_flow.h"
#include "coupling/transport/beside_solids.h"
#include "coupling/transport/transport.h"
#include "coupling/transport/two_fluids.h"
#include "fluid/boundary/domain.h"
#include "fluid/transport/advection.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"
#include "levelset/extrapolate.h"

namespace seiche {
namespace {

constexpr int straight_layers = 2;  // layers of linear extrapolation; constant beyond

// Velocities of the solids at faces, m/s. Deforming solids have one only on faces that they close, near their surface.
template <int Dim>
class SolidVelocities {
 public:
  SolidVelocities(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g)
      : g_(g), layout_(domain.layout), shares_(solids.bodies.size()) {
    for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
      if (!g.deforms(int(k))) continue;
      for (std::size_t n = 0; n < g.shares[k]->size(); ++n)
        shares_[k][std::size_t((*g.shares[k])[n].axis)][(*g.shares[k])[n].face] = n;
    }
  }
  std::optional<Vec<Dim>> at(int body, int axis, Site face) const {
    if (!g_.deforms(body)) {
      const Vec3 x = extend<Dim>(layout_.position(layout_.index(face), face_offset<Dim>(axis)));
      return truncate<Dim>(g_.placed[std::size_t(body)].twist.at(x));
    }
    const auto& faces = shares_[std::size_t(body)][std::size_t(axis)];
    const auto found = faces.find(face);
    if (found == faces.end()) return {};
    const SurfaceWeights& weights = (*g_.face_weights[std::size_t(body)])[found->second];
    if (weights.empty()) return {};
    Vec<Dim> v;
    for (int b = 0; b < Dim; ++b) v[b] = velocity_at<Dim>(weights, b, g_.placed[std::size_t(body)].velocity);
    return v;
  }

 private:
  const StepGeometry<Dim>& g_;
  const Layout<Dim>& layout_;
  std::vector<std::array<std::unordered_map<Site, std::size_t>, Dim>> shares_;
};

// True if viscous liquid sticks to this body (-1: none).
template <int Dim>
bool liquid_sticks_to(const Fluids& fluids, const Solids<Dim>& solids, int body) {
  return fluids.is_viscous() && body >= 0 && solids.bodies[std::size_t(body)].spec().slip == Slip::no_slip;
}

// At the nearest point s of the surface, x - psi n, the normal velocity is the solid's, v. In solids the extrapolated
// velocity is shifted by the same amount, u(x) += ((v - u(s)).n) n: it keeps its slope across the surface, so transport
// beside it is of second order. Beside gas, enclosed air and fast deforming solids u is shifted at x itself, so that
// its normal part is constant (docs/decisions/0049-flow-beside-solids.md). Solved faces keep theirs. If liquid sticks
// to the solid, linear extrapolation already passes through the solid's velocity at its surface. Deeper than
// straight_layers, u is then the solid's velocity.
template <int Dim>
void follow_solids(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                   const StepGeometry<Dim>& g, const SolidVelocities<Dim>& moving, const FaceField<Dim, char>& valid,
                   const FaceField<Dim, char>& reached, FaceField<Dim>& u) {
  const FaceField<Dim> old = u;
  const Layout<Dim>& l = domain.layout;
  for (int a = 0; a < Dim; ++a)
    for_each_marked_index(l, l.faces(a), reached[a].data(), [&](Site f, const IVec<Dim>& i) {
      if (valid.at(a, f) || g.psi[f] > 2 * l.h()) return;
      const FaceDistance<Dim> d = distance_at_face(l, g.psi, a, f);
      const double norm = d.gradient.norm();
      if (d.psi > 0 || norm == 0) return;
      const Vec<Dim> n = d.gradient / norm;
      const std::optional<Vec<Dim>> v = moving.at(g.body[f], a, f);
      if (v && liquid_sticks_to(fluids, solids, g.body[f])) {
        if (d.psi < -straight_layers * l.h()) u.at(a, f) = (*v)[a];
        return;
      }
      const bool constant = fluids.has_gas() || fluids.keeps_air() || !g.continues_flow(g.body[f]);
      const double depth = constant ? 0 : std::min(-d.psi, straight_layers * l.h());
      const Vec<Dim> surface = l.position(i, face_offset<Dim>(a)) + depth * n;
      if (v) u.at(a, f) += (*v - sample_velocity(l, old, surface)).dot(n) * n[a];
    });
}

// Invalidates all faces of a level but the marked ones, and sets their u, q and n to 0.
template <int Dim>
void keep_faces(const Layout<Dim>& layout, const FaceField<Dim, char>& marked, TimeLevel<Dim>& level) {
  for (int a = 0; a < Dim; ++a) {
    const bool viscous = !level.n[a].empty();
    const auto may_matter = [&](Site f) {
      return !all_marked(marked[a].data() + f) &&
             (any_marked(level.valid[a].data() + f) || !all_zero(level.u[a].data() + f) ||
              !all_zero(level.q[a].data() + f) || (viscous && !all_zero(level.n[a].data() + f)));
    };
    for_each_possible(layout, layout.faces(a), may_matter, [&](Site f) {
      if (marked.at(a, f)) return;
      set_if_other(level.valid.at(a, f), char(face_invalid));
      set_if_other(level.u.at(a, f), 0.0);
      set_if_other(level.q.at(a, f), 0.0);
      if (viscous) set_if_other(level.n.at(a, f), 0.0);
    });
  }
}

// Calls body(face) for the owned faces across an axis that lie on sides of the domain.
template <int Dim, class Body>
void for_each_on_sides(const Domain<Dim>& domain, int axis, const Body& body) {
  for (const int side : {0, 1}) for_each_site(domain.layout, faces_of_side(domain.layout, axis, side), body);
}

// Sets the given velocity on walls and inflow sides, wet or dry. Fills ghosts. Collective.
template <int Dim>
void keep_prescribed(const Domain<Dim>& domain, const StepGeometry<Dim>& g, FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    for_each_on_sides(domain, a, [&](Site f) {
      if (g.faces.kind_at(a, f) == FaceKind::prescribed) set_if_other(u.at(a, f), g.faces.prescribed.at(a, f));
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, u);
}

// True if the pressure's link across the face ends at the surface.
template <int Dim>
bool ends_at_surface(const ProjectionInput<Dim>& in, int axis, Site f) {
  return !in.has_gas() && in.faces.kind_at(axis, f) != FaceKind::outflow &&
         in.is_liquid(f) != in.is_liquid(f - in.layout.stride(axis));
}

// True if velocity goes on by a parabola beside the surface: beside gravity waves under gas. With tension, drops at
// rest and bubbles do worse (decision 19).
template <int Dim>
bool bends_beyond_surface(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids) {
  return fluids.has_gas() && fluids.has_gravity_waves() && solids.bodies.empty() && !domain.sides.any_waves();
}

}  // namespace

template <int Dim>
void continue_velocity(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                       const StepGeometry<Dim>& g, const FaceField<Dim, char>& valid, FaceField<Dim>& u) {
  FaceField<Dim, char> reached = valid;
  const SolidVelocities<Dim> moving(domain, solids, g);
  const bool bends = bends_beyond_surface(domain, fluids, solids);
  for (int a = 0; a < Dim; ++a) {
    // Inflow also sets the velocity of the air in front of it.
    for_each_marked(domain.layout, domain.layout.faces(a), valid[a].data(), [&](Site f) { reached.at(a, f) = 1; });
    for_each_on_sides(domain, a, [&](Site f) {
      if (g.faces.kind_at(a, f) != FaceKind::prescribed) return;
      set_if_other(u.at(a, f), g.faces.prescribed.at(a, f));
      if (u.at(a, f) != 0) reached.at(a, f) = 1;
    });
    for (const SealedFace& f : g.sealed)
      if (f.axis == a && !valid.at(a, f.face)) {
        u.at(a, f.face) = moving.at(f.body, a, f.face).value_or(Vec<Dim>::Zero())[a];
        reached.at(a, f.face) = 1;
      }
    const auto is_clear = [&](Site f) { return bends && g.faces.open.at(a, f) == 1; };
    extrapolate(domain.layout, domain.halo, domain.layout.faces(a),
                {domain.extrapolated_layers(), straight_layers, is_clear}, u[a], reached[a]);
  }
  keep_prescribed(domain, g, u);
  if (solids.bodies.empty()) return;
  follow_solids(domain, fluids, solids, g, moving, valid, reached, u);
  keep_prescribed(domain, g, u);
}

template <int Dim>
void continue_level(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                    const StepGeometry<Dim>& g, const FaceField<Dim, char>& near, TimeLevel<Dim>& level) {
  keep_faces(domain.layout, near, level);
  continue_velocity(domain, fluids, solids, g, level.valid, level.u);
  domain.halo.fill_ghosts(level.valid);
}

template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> initial_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                    const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                                                    const FaceField<Dim, char>& near, FaceField<Dim> u) {
  TimeLevel<Dim> level = empty_level(domain.layout, fluids.is_viscous());
  level.valid = near;
  level.u = std::move(u);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (g.faces.kind_at(a, f) == FaceKind::closed) level.valid.at(a, f) = face_invalid, level.u.at(a, f) = 0;
      if (level.valid.at(a, f) && g.faces.kind_at(a, f) == FaceKind::prescribed) level.valid.at(a, f) = face_prescribed;
    });
  continue_level(domain, fluids, solids, g, near, level);
  return std::make_shared<TimeLevel<Dim>>(std::move(level));
}

template <int Dim>
TimeLevel<Dim> solved_level(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                            const OperatorPerturbation& perturbation, const ProjectionInput<Dim>& in,
                            const PressureRows<Dim>& rows, const CellField<Dim>& pressure, const FaceField<Dim>& u_star,
                            const StepGeometry<Dim>& g) {
  TimeLevel<Dim> level = empty_level(domain.layout, fluids.is_viscous());
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      const Site low = f - domain.layout.stride(a);
      const bool wet = rows.touch_pressure(low, f);
      if (!wet || in.faces.kind_at(a, f) == FaceKind::closed) return;
      if (in.faces.kind_at(a, f) == FaceKind::prescribed) {
        level.valid.at(a, f) = face_prescribed;
        level.u.at(a, f) = in.faces.prescribed.at(a, f);
        return;
      }
      if (in.faces.open.at(a, f) >= least_open || liquid_sticks_to(fluids, solids, g.body[f]))
        level.valid.at(a, f) = ends_at_surface(in, a, f) ? face_at_surface : face_solved;
      level.q.at(a, f) = face_pressure_slope(in, rows, pressure, a, f);
      level.u.at(a, f) = u_star.at(a, f) - perturbation.pressure_gradient * in.dt * level.q.at(a, f);
    });
  domain.halo.fill_ghosts(level.u);
  return level;
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template void continue_level<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const StepGeometry<D>&,       \
                                  const FaceField<D, char>&, TimeLevel<D>&);                                       \
  template void continue_velocity<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const StepGeometry<D>&,    \
                                     const FaceField<D, char>&, FaceField<D>&);                                    \
  template std::shared_ptr<const TimeLevel<D>> initial_level<D>(const Domain<D>&, const Fluids&, const Solids<D>&, \
                                                                const StepGeometry<D>&, const FaceField<D, char>&, \
                                                                FaceField<D>);                                     \
  template TimeLevel<D> solved_level<D>(                                                                           \
      const Domain<D>&, const Fluids&, const Solids<D>&, const OperatorPerturbation&, const ProjectionInput<D>&,   \
      const PressureRows<D>&, const CellField<D>&, const FaceField<D>&, const StepGeometry<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
