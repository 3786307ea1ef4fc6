#include "coupling/thin/liquid_beside.h"

#include <Eigen/Geometry>

#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

// True if a wet cell has no face of unknown velocity.
template <int Dim>
bool is_shut_in(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi, Site cell) {
  bool shut = phi[cell] < 0;
  for_each_face_of(domain.layout, cell, [&](int a, Site f, int, Site) { shut = shut && !g.faces.is_unknown(a, f); });
  return shut;
}

// Depths of the liquid between a sealed face's body and the centres of the adjacent cells, m. inert: all liquid that
// moves with the body. heavy: the part with weight. A shut-in cell counts with h/2. It has no weight if its centre lies
// in the body.
struct Depths {
  double inert = 0, heavy = 0;
};

// Sums over the cells that this rank owns. has_row(cell): its pressure is an unknown.
template <int Dim, class HasRow>
Depths wet_depths(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const HasRow& has_row,
                  const CellField<Dim>& phi, const SealedFace& f) {
  const std::array<Site, 2> cells = {f.face - domain.layout.stride(f.axis), f.face};
  Depths sum;
  for (std::size_t side = 0; side < 2; ++side) {
    const Site c = cells[side];
    if (!domain.layout.cells().contains(domain.layout.index(c))) continue;
    const bool shut = !has_row(c);
    if (shut && !is_shut_in(domain, g, phi, c)) continue;
    const double depth = shut ? 0.5 * domain.layout.h() : f.gaps[side];
    sum.inert += depth;
    if (!shut || f.gaps[side] > 0) sum.heavy += depth;
  }
  return sum;
}

// use(face, share, weights) for the sealed faces of the deforming body k. Its shares are in the order of these faces.
template <int Dim, class Use>
void for_each_sealed(const StepGeometry<Dim>& g, int k, const Use& use) {
  const FaceShares& shares = *g.shares[std::size_t(k)];
  const FaceWeights& weights = *g.face_weights[std::size_t(k)];
  std::size_t n = 0;
  for (const SealedFace& f : g.sealed) {
    if (f.body != k) continue;
    while (shares[n].axis != f.axis || shares[n].face != f.face) ++n;
    use(f, shares[n].closed, weights[n]);
  }
}

// Explicit Euler step of da/dt = -|a| a/h, clipped at zero: a deviation that would cross a cell in the step vanishes.
double slowed(double a, double dt, double h) {
  return a * std::max(0., 1 - dt * std::abs(a) / h);
}

}  // namespace

template <int Dim>
LiquidBeside liquid_beside(const Domain<Dim>& domain, const Fluids& fluids, const StepGeometry<Dim>& g,
                           const PressureRows<Dim>& rows, const State<Dim>& state, double dt, int k) {
  const Eigen::VectorXd w = state.solids[std::size_t(k)].velocity();
  const auto size = std::size_t(w.size());
  std::vector<double> sums(3 * size);  // mass, heavy, momentum
  const auto has_row = [&](Site c) { return rows.row[c] != PressureRows<Dim>::no_row; };
  for_each_sealed(g, k, [&](const SealedFace& f, double share, const SurfaceWeights& weights) {
    const double area = share * domain.layout.geometry().face_area();
    const Depths depths = wet_depths(domain, g, has_row, state.phi, f);
    const double mass = area * fluids.density() * depths.inert, heavy = area * fluids.density() * depths.heavy;
    const double mean = velocity_at<Dim>(weights, f.axis, w), flow = state.now->u.at(f.axis, f.face);
    for (const auto& [node, weight] : weights) {
      const auto i = std::size_t(Dim * node + f.axis);
      sums[i] += mass * weight;
      sums[size + i] += heavy * weight;
      sums[2 * size + i] += mass * weight * (flow + slowed(w[Eigen::Index(i)] - mean, dt, domain.layout.h()));
    }
  });
  domain.ranks.global_sum(sums);
  const auto part = [&](std::size_t first) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(sums.data() + first, Eigen::Index(size)));
  };
  return {part(0), part(size), part(2 * size)};
}

// sum_f rho A/2 (s (d_low + d_high) sum_n weight_n w_n^2 - h/2 (share_low u_low^2 + share_high u_high^2)), with the
// velocities that the cells on both sides take for the face.
template <int Dim>
double kinetic_energy_beside(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                             const StepGeometry<Dim>& g, const State<Dim>& state) {
  if (!has_thin_elastic(solids)) return 0;
  const Layout<Dim>& l = domain.layout;
  const auto has_pressure = [&](Site c) { return state.phi[c] < 0 && !is_shut_in(domain, g, state.phi, c); };
  const auto counted = [&](const SealedFace& f, Site c) {
    if (!l.cells().contains(l.index(c))) return 0.;
    const FacePair u = solved_faces(l, *state.now, f.axis, c);
    return 0.5 * l.h() * liquid_share(l, state.phi, g.psi, c) * std::pow(c == f.face ? u.low : u.high, 2);
  };
  double sum = 0;
  for (int k = 0; k < int(solids.bodies.size()); ++k) {
    const Body<Dim>& body = solids.bodies[std::size_t(k)];
    if (!body.is_thin() || !body.deforms()) continue;
    const Eigen::VectorXd w = state.solids[std::size_t(k)].velocity();
    for_each_sealed(g, k, [&](const SealedFace& f, double share, const SurfaceWeights& weights) {
      double square = 0;
      for (const auto& [node, weight] : weights) square += weight * std::pow(w[Dim * Eigen::Index(node) + f.axis], 2);
      sum += share * wet_depths(domain, g, has_pressure, state.phi, f).inert * square;
      sum -= counted(f, f.face - l.stride(f.axis)) + counted(f, f.face);
    });
  }
  return 0.5 * fluids.density() * l.geometry().face_area() * domain.ranks.global_sum(sum);
}

template <int Dim>
bool has_thin_elastic(const Solids<Dim>& solids) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(),
                     [](const Body<Dim>& b) { return b.is_thin() && b.deforms(); });
}

template <int Dim>
double volume_beyond(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                     const CellField<Dim>& phi) {
  if (!has_thin_elastic(solids)) return 0;
  const Layout<Dim>& l = domain.layout;
  double sum = 0;
  for (const SealedFace& f : g.sealed) {
    const std::array<Site, 2> cells = {f.face - l.stride(f.axis), f.face};
    for (std::size_t side = 0; side < 2 && g.deforms(f.body); ++side) {
      const Site c = cells[side];
      if (!l.cells().contains(l.index(c)) || phi[c] >= 0) continue;
      const bool within = f.gaps[side] == 0;
      const double counted = 0.5 * l.h() * (within ? liquid_share(l, phi, g.psi, c) : 1);
      sum += f.weight * (counted - f.gaps[side]) * l.geometry().face_area();
    }
  }
  return domain.ranks.global_sum(sum);
}

template <int Dim>
Eigen::VectorXd total_load(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const Eigen::VectorXd& forces) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6);
  for (std::size_t n = 0; n < solid.body.mesh.nodes.size(); ++n) {
    const Eigen::Index i = Dim * Eigen::Index(n);
    const Vec3 x = extend<Dim>(Vec<Dim>(solid.body.mesh.nodes[n] + u.segment<Dim>(i)));
    const Vec3 f = extend<Dim>(Vec<Dim>(forces.segment<Dim>(i)));
    load.head<3>() += f;
    load.tail<3>() += x.cross(f);
  }
  return load;
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template LiquidBeside liquid_beside<D>(const Domain<D>&, const Fluids&, const StepGeometry<D>&,                     \
                                         const PressureRows<D>&, const State<D>&, double, int);                       \
  template double kinetic_energy_beside<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const StepGeometry<D>&, \
                                           const State<D>&);                                                          \
  template bool has_thin_elastic<D>(const Solids<D>&);                                                                \
  template double volume_beyond<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, const CellField<D>&);  \
  template Eigen::VectorXd total_load<D>(const ElasticSolid<D>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
