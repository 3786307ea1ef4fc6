#include "coupling/transport/wall_viscosity.h"

#include "coupling/solids/load_sums.h"
#include "coupling/state/fluids.h"
#include "coupling/transport/restore.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Share of these terms in a step: 1 up to mu dt/(rho h^2) = 1/2, 0 from 1 on, as for the trend of N. Stiff stress
// balances the pressure; a part of it from the step before does not.
template <int Dim>
double share_of_explicit(const State<Dim>& state, double dt) {
  return state.viscous_rate > 0 ? std::clamp(2 - 2 * dt * state.viscous_rate, 0.0, 1.0) : 0;
}

template <int Dim>
std::vector<Vec3> reference_points(const Solids<Dim>& solids, const StepGeometry<Dim>& g) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    points.push_back(g.placed[k].pose.apply(solids.bodies[k].reference_point()));
  return points;
}

// A link of a face to its neighbour along an axis: the length (cells) and the slope h du'/dx outwards, m/s.
struct WallLink {
  double length = 1, slope = 0;
  bool to_wall = false;
};

template <int Dim>
class WallStress {
 public:
  WallStress(const Layout<Dim>& layout, const NoSlipSolids<Dim>& solids, const StepGeometry<Dim>& g,
             const TimeLevel<Dim>& now)
      : layout_(layout), solids_(solids), g_(g), now_(now) {}

  // h^2/nu times the acceleration that the operator lacks at a face outside the solids, m/s, and the solid that bears
  // the reaction: sum over the axes of (2/(theta- + theta+) - 1/w) S.
  std::pair<double, int> at(int a, Site f, const IVec<Dim>& i) const {
    const auto [solid, psi] = solids_.nearest(a, f);
    if (solid < 0 || psi <= 0 || psi > 2 * layout_.h() || !is_solved(now_.valid.at(a, f))) return {0, -1};
    const double w = g_.faces.open.at(a, f), own = relative(solid, a, f, i);
    if (w <= 0) return {0, -1};
    double sum = 0;
    for (int b = 0; b < Dim; ++b) {
      const auto low = link(solid, psi, own, a, f, i, b, -1), high = link(solid, psi, own, a, f, i, b, 1);
      if (!low || !high) continue;
      const double length = std::max(low->length + high->length, 1.0);
      sum += (2 / length - 1 / w) * (low->slope + high->slope);
    }
    return {sum, solid};
  }
  double relative(int solid, int a, Site f, const IVec<Dim>& i) const {
    return now_.u.at(a, f) - solids_.velocity(solid, layout_.position(i, face_offset<Dim>(a)))[a];
  }

 private:
  std::optional<WallLink> link(int solid, double psi, double own, int a, Site f, const IVec<Dim>& i, int b,
                               int side) const {
    const Site g = f + side * layout_.stride(b);
    const auto [k, there] = solids_.nearest(a, g);
    if (k >= 0 && there <= 0) {
      const double theta = std::clamp(psi / (psi - there), 1e-3, 1.0);
      return WallLink{theta, -own / theta, true};
    }
    if (!is_solved(now_.valid.at(a, g))) return {};
    return WallLink{1, relative(solid, a, g, i + side * IVec<Dim>::Unit(b)) - own, false};
  }

  const Layout<Dim>& layout_;
  const NoSlipSolids<Dim>& solids_;
  const StepGeometry<Dim>& g_;
  const TimeLevel<Dim>& now_;
};

}  // namespace

template <int Dim>
WallForces add_wall_viscosity(const Setup<Dim>& s, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                              const StepGeometry<Dim>& g, double dt, FaceField<Dim>& u_star) {
  const Layout<Dim>& layout = s.domain.layout;
  const double share = share_of_explicit(state, dt);
  if (!solids.any() || share == 0 || !s.fluids.constant_viscosity() || state.exterior->flows()) return {};
  const WallStress<Dim> stress(layout, solids, g, *state.now);
  const double mass = s.fluids.density() * layout.geometry().cell_volume();
  LoadSums sums(reference_points(s.solids, g));
  double power = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (g.psi[f] > 4 * layout.h() || !(state.phi[f] < 0 && state.phi[f - layout.stride(a)] < 0)) return;
      const auto [lacking, k] = stress.at(a, f, i);
      if (lacking == 0) return;
      const double added = share * state.viscous_rate * dt * lacking;
      const double force = mass * g.faces.open.at(a, f) * added / dt;
      u_star.at(a, f) += added;
      power += force * stress.relative(k, a, f, i);
      sums.add(k, extend<Dim>(layout.position(i, face_offset<Dim>(a))), -force * Vec3::Unit(a));
    });
  return {sums.total(s.domain.ranks), s.domain.ranks.global_sum(power)};
}

template <int Dim>
std::vector<SolidLoad> stop_in_slits(const Setup<Dim>& s, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                                     const StepGeometry<Dim>& g, double dt, FaceField<Dim>& u_star) {
  const Layout<Dim>& layout = s.domain.layout;
  const double share = share_of_explicit(state, dt);
  if (!solids.any() || share == 0) return {};
  LoadSums sums(reference_points(s.solids, g));
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      const double open = g.faces.open.at(a, f);
      if (open <= 0 || open >= 1 || !g.faces.is_unknown(a, f)) return;
      const int k = solids.around(a, f);
      if (k < 0) return;
      const Vec<Dim> x = layout.position(i, face_offset<Dim>(a));
      const double change = share * (solids.velocity(k, x)[a] - u_star.at(a, f));
      u_star.at(a, f) += change;
      if (s.solids.bodies[std::size_t(k)].is_free()) return;
      const bool wet = state.phi[f] < 0 || state.phi[f - layout.stride(a)] < 0;
      const double density = wet ? s.fluids.density() : state.exterior->flows() ? s.fluids.gas_density() : 0;
      sums.add(k, extend<Dim>(x), -density * open * layout.geometry().cell_volume() * change / dt * Vec3::Unit(a));
    });
  return sums.total(s.domain.ranks);
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template WallForces add_wall_viscosity<D>(const Setup<D>&, const NoSlipSolids<D>&, const State<D>&,        \
                                            const StepGeometry<D>&, double, FaceField<D>&);                  \
  template std::vector<SolidLoad> stop_in_slits<D>(const Setup<D>&, const NoSlipSolids<D>&, const State<D>&, \
                                                   const StepGeometry<D>&, double, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
