#include "coupling/thin/liquid_beside.h"

#include <Eigen/Geometry>

#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

// A wet cell without a row, among sealed faces alone.
template <int Dim>
bool is_shut_in(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi, Site cell) {
  bool shut = phi[cell] < 0;
  for_each_face_of(domain.layout, cell, [&](int a, Site f, int, Site) { shut = shut && !g.faces.is_unknown(a, f); });
  return shut;
}

// Depths of what lies between a sealed face's body and the centres of the cells beside it, m: of all that is held to
// move with it, and of what weighs on it. What is shut in has all on the face's side of its centre; it weighs nothing
// where the body fills it.
struct Depths {
  double inert = 0, heavy = 0;
};

// Of the cells that are this rank's.
template <int Dim>
Depths wet_depths(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                  const CellField<Dim>& phi, const SealedFace& f) {
  const std::array<Site, 2> cells = {f.face - domain.layout.stride(f.axis), f.face};
  Depths sum;
  for (std::size_t side = 0; side < 2; ++side) {
    const Site c = cells[side];
    if (!domain.layout.cells().contains(domain.layout.index(c))) continue;
    const bool shut = rows.row[c] == PressureRows<Dim>::no_row;
    if (shut && !is_shut_in(domain, g, phi, c)) continue;
    const double depth = shut ? 0.5 * domain.layout.h() : f.gaps[side];
    sum.inert += depth;
    if (!shut || f.gaps[side] > 0) sum.heavy += depth;
  }
  return sum;
}

// da/dt = -|a| a/h by Euler's step, down to nothing: what would cross a cell in the step is gone.
double slowed(double a, double dt, double h) {
  return a * std::max(0., 1 - dt * std::abs(a) / h);
}

}  // namespace

template <int Dim>
LiquidBeside liquid_beside(const Domain<Dim>& domain, const Fluids& fluids, const StepGeometry<Dim>& g,
                           const PressureRows<Dim>& rows, const State<Dim>& state, double dt, int k) {
  const FaceShares& shares = *g.shares[std::size_t(k)];
  const Eigen::VectorXd w = state.solids[std::size_t(k)].velocity();
  const auto size = std::size_t(w.size());
  std::vector<double> sums(3 * size);  // mass, what of it weighs, momentum
  std::size_t n = 0;                   // shares and sealed faces are in the same order
  for (const SealedFace& f : g.sealed) {
    if (f.body != k) continue;
    while (shares[n].axis != f.axis || shares[n].face != f.face) ++n;
    const SurfaceWeights& weights = (*g.face_weights[std::size_t(k)])[n];
    const double area = shares[n].closed * domain.layout.geometry().face_area();
    const Depths depths = wet_depths(domain, g, rows, state.phi, f);
    const double mass = area * fluids.density() * depths.inert, heavy = area * fluids.density() * depths.heavy;
    const double mean = velocity_at<Dim>(weights, f.axis, w), flow = state.now->u.at(f.axis, f.face);
    for (const auto& [node, weight] : weights) {
      const auto i = std::size_t(Dim * node + f.axis);
      sums[i] += mass * weight;
      sums[size + i] += heavy * weight;
      sums[2 * size + i] += mass * weight * (flow + slowed(w[Eigen::Index(i)] - mean, dt, domain.layout.h()));
    }
  }
  domain.ranks.global_sum(sums);
  const auto part = [&](std::size_t first) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(sums.data() + first, Eigen::Index(size)));
  };
  return {part(0), part(size), part(2 * size)};
}

template <int Dim>
bool has_thin_elastic(const Solids<Dim>& solids) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(),
                     [](const Body<Dim>& b) { return b.is_thin() && b.elements(); });
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

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template LiquidBeside liquid_beside<D>(const Domain<D>&, const Fluids&, const StepGeometry<D>&,                    \
                                         const PressureRows<D>&, const State<D>&, double, int);                      \
  template bool has_thin_elastic<D>(const Solids<D>&);                                                               \
  template double volume_beyond<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, const CellField<D>&); \
  template Eigen::VectorXd total_load<D>(const ElasticSolid<D>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
