#include "coupling/transport/wall_viscosity.h"

#include "coupling/state/fluids.h"
#include "coupling/transport/restore.h"
#include "fluid/viscosity/load_sums.h"
#include "grid/loops.h"

namespace seiche {
namespace {

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
};

template <int Dim>
class WallStress {
 public:
  // `flow`: at the start of the step, continued through the walls.
  WallStress(const Layout<Dim>& layout, const NoSlipSolids<Dim>& solids, const StepGeometry<Dim>& g,
             const CellField<Dim>& phi, const FaceField<Dim>& flow)
      : layout_(layout), solids_(solids), g_(g), phi_(phi), flow_(flow) {}

  // h^2/nu times the acceleration that the operator lacks at a face outside the solids, m/s, and the solid that bears
  // the reaction: sum over the axes of (2/(theta- + theta+) - 1/w) S.
  std::pair<double, int> at(int a, Site f, const IVec<Dim>& i) const {
    const auto [solid, psi] = solids_.nearest(a, f);
    if (solid < 0 || psi <= 0 || psi > 2 * layout_.h() || !is_known(a, f)) return {0, -1};
    const double w = g_.faces.open.at(a, f), own = relative(solid, a, i);
    double sum = 0;
    for (int b = 0; b < Dim; ++b) {
      const auto low = link(solid, psi, own, a, f, i, b, -1), high = link(solid, psi, own, a, f, i, b, 1);
      if (!low || !high) continue;
      const double length = std::max(low->length + high->length, 1.0);
      sum += (2 / length - 1 / w) * (low->slope + high->slope);
    }
    return {sum, solid};
  }
  // Velocity at a face relative to the solid: the flow moves along with it, as far as it has moved since they fitted.
  double relative(int solid, int a, const IVec<Dim>& i) const {
    const Vec<Dim> x = layout_.position(i, face_offset<Dim>(a));
    return solids_.moved_flow(flow_, solid, a, i) - solids_.velocity(solid, x)[a];
  }

 private:
  // True if liquid is on both sides of an open face.
  bool is_known(int a, Site f) const {
    return phi_[f] < 0 && phi_[f - layout_.stride(a)] < 0 && g_.faces.open.at(a, f) > 0 && g_.faces.is_unknown(a, f);
  }
  std::optional<WallLink> link(int solid, double psi, double own, int a, Site f, const IVec<Dim>& i, int b,
                               int side) const {
    const Site g = f + side * layout_.stride(b);
    const auto [k, there] = solids_.nearest(a, g);
    if (k >= 0 && there <= 0) {
      const double theta = std::clamp(psi / (psi - there), 1e-3, 1.0);
      return WallLink{theta, -own / theta};
    }
    if (!is_known(a, g)) return {};
    return WallLink{1, relative(solid, a, i + side * IVec<Dim>::Unit(b)) - own};
  }

  const Layout<Dim>& layout_;
  const NoSlipSolids<Dim>& solids_;
  const StepGeometry<Dim>& g_;
  const CellField<Dim>& phi_;
  const FaceField<Dim>& flow_;
};

// Calls body(face, position, solid) for the owned faces open in part with their centre in a solid.
template <int Dim, class Body>
void for_each_slit(const Layout<Dim>& layout, const NoSlipSolids<Dim>& solids, const StepGeometry<Dim>& g, int axis,
                   const Body& body) {
  for_each_index_in_order(layout, layout.faces(axis), [&](Site f, const IVec<Dim>& i) {
    const double open = g.faces.open.at(axis, f);
    if (open <= 0 || open >= 1 || !g.faces.is_unknown(axis, f)) return;
    if (const int k = solids.around(axis, f); k >= 0) body(f, layout.position(i, face_offset<Dim>(axis)), k);
  });
}

// Share to which slits stop: 1 up to mu dt/(rho h^2) = 1/2, 0 from 1 on, where the operator stops them; 0 while this is
// unknown.
template <int Dim>
double share_of_slits(const NoSlipSolids<Dim>& solids, const State<Dim>& state, double dt) {
  return solids.any() && state.viscous_rate > 0 ? std::clamp(2 - 2 * dt * state.viscous_rate, 0.0, 1.0) : 0;
}

// Change (m/s) of a slit's velocity with which it ends the step with the solid's, `wall`, if the pressure gradient of
// the step before goes on: u + fall + change - dt q = wall.
template <int Dim>
double stopping(const TimeLevel<Dim>& now, int a, Site f, double wall, double dt, double fall) {
  const double held = is_solved(now.valid.at(a, f)) ? fall - dt * now.q.at(a, f) : 0;
  return wall - now.u.at(a, f) - held;
}

}  // namespace

template <int Dim>
WallForces add_wall_viscosity(const Setup<Dim>& s, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                              const StepGeometry<Dim>& g, const FaceField<Dim>& flow, double dt,
                              FaceField<Dim>& u_star) {
  const Layout<Dim>& layout = s.domain.layout;
  if (!solids.any() || state.viscous_rate == 0 || !s.fluids.constant_viscosity() || state.exterior->flows()) return {};
  const WallStress<Dim> stress(layout, solids, g, state.phi, flow);
  const double mass = s.fluids.density() * layout.geometry().cell_volume();
  LoadSums sums(reference_points(s.solids, g));
  double power = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (g.psi[f] > 4 * layout.h() || !(state.phi[f] < 0 && state.phi[f - layout.stride(a)] < 0)) return;
      const auto [lacking, k] = stress.at(a, f, i);
      if (lacking == 0) return;
      const double added = state.viscous_rate * dt * lacking;
      const double force = mass * g.faces.open.at(a, f) * added / dt;
      u_star.at(a, f) += added;
      power += force * stress.relative(k, a, i);
      sums.add(k, extend<Dim>(layout.position(i, face_offset<Dim>(a))), -force * Vec3::Unit(a));
    });
  return {sums.total(s.domain.ranks), s.domain.ranks.global_sum(power)};
}

template <int Dim>
void stop_in_slits(const Domain<Dim>& domain, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                   const StepGeometry<Dim>& g, const TimeLevel<Dim>& now, const Vec3& gravity, double dt,
                   FaceField<Dim>& u) {
  if (!solids.any()) return;
  const double share = share_of_slits(solids, state, dt);
  for (int a = 0; a < Dim; ++a)
    for_each_slit(domain.layout, solids, g, a, [&](Site f, const Vec<Dim>& x, int k) {
      u.at(a, f) =
          now.u.at(a, f) + dt * gravity[a] + share * stopping(now, a, f, solids.velocity(k, x)[a], dt, dt * gravity[a]);
    });
}

template <int Dim>
void add_slit_loads(const Setup<Dim>& s, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                    const StepGeometry<Dim>& g, double dt, KnownLoads& loads) {
  const Layout<Dim>& layout = s.domain.layout;
  const double share = share_of_slits(solids, state, dt), volume = layout.geometry().cell_volume();
  if (share == 0) return;
  const Vec3 gravity = s.perturbation.gravity * s.fluids.gravity.of_step(state.time + dt, dt);
  const auto now = state.exterior->joined_level(s.domain, s.fluids, state);
  const std::vector<Vec3> about = reference_points(s.solids, g);
  LoadSums sums(about);
  std::vector<double> inertia(36 * about.size());
  for (int a = 0; a < Dim; ++a)
    for_each_slit(layout, solids, g, a, [&](Site f, const Vec<Dim>& x, int k) {
      const bool wet = state.phi[f] < 0 || state.phi[f - layout.stride(a)] < 0;
      const double density = wet ? s.fluids.density() : state.exterior->flows() ? s.fluids.gas_density() : 0;
      const double change = share * stopping(*now, a, f, solids.velocity(k, x)[a], dt, dt * gravity[a]);
      const double mass = density * g.faces.open.at(a, f) * volume;
      sums.add(k, extend<Dim>(x), -mass * change / dt * Vec3::Unit(a));
      Eigen::Matrix<double, 6, 1> arm;
      arm << Vec3::Unit(a), Vec3(extend<Dim>(x) - about[std::size_t(k)]).cross(Vec3::Unit(a));
      Eigen::Map<Eigen::Matrix<double, 6, 6>>(&inertia[36 * std::size_t(k)]) += share * mass * arm * arm.transpose();
    });
  s.domain.ranks.global_sum(inertia);
  loads.carrying = sums.total(s.domain.ranks);
  for (std::size_t k = 0; k < about.size(); ++k)
    loads.carried.emplace_back(Eigen::Map<Eigen::Matrix<double, 6, 6>>(&inertia[36 * k]));
}

#define SEICHE_INSTANTIATE(D)                                                                                       \
  template WallForces add_wall_viscosity<D>(const Setup<D>&, const NoSlipSolids<D>&, const State<D>&,               \
                                            const StepGeometry<D>&, const FaceField<D>&, double, FaceField<D>&);    \
  template void stop_in_slits<D>(const Domain<D>&, const NoSlipSolids<D>&, const State<D>&, const StepGeometry<D>&, \
                                 const TimeLevel<D>&, const Vec3&, double, FaceField<D>&);                          \
  template void add_slit_loads<D>(const Setup<D>&, const NoSlipSolids<D>&, const State<D>&, const StepGeometry<D>&, \
                                  double, KnownLoads&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
