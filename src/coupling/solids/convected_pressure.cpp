#include "coupling/solids/convected_pressure.h"

#include <algorithm>
#include <unordered_map>

#include "coupling/solids/pressure_loads.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
bool carries_pressure(const Body<Dim>& body) {
  return body.moves() && !body.is_thin() && !body.deforms();
}

// Velocities of solids in the cells beside the faces that they close, weighted by closed shares.
template <int Dim>
struct VelocityAtCell {
  double weight = 0;
  Vec<Dim> sum = Vec<Dim>::Zero();
};

template <int Dim>
using VelocitiesAtCells = std::unordered_map<Site, VelocityAtCell<Dim>>;

template <int Dim>
VelocitiesAtCells<Dim> velocities_at_cells(const Layout<Dim>& layout, const StepGeometry<Dim>& g,
                                           const Solids<Dim>& solids, const std::vector<Placement>& placed) {
  VelocitiesAtCells<Dim> cells;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    if (!carries_pressure(solids.bodies[k])) continue;
    for (const FaceShare& share : *g.shares[k]) {
      const Vec3 x = extend<Dim>(layout.position(layout.index(share.face), face_offset<Dim>(share.axis)));
      const Vec<Dim> v = truncate<Dim>(placed[k].twist.at(x));
      for (const Site c : {share.face, share.face - layout.stride(share.axis)}) {
        if (!layout.cells().contains(layout.index(c))) continue;
        cells[c].weight += share.closed;
        cells[c].sum += share.closed * v;
      }
    }
  }
  return cells;
}

// The acceleration at a cell centre, m/s^2.
template <int Dim>
Vec<Dim> at_cell(const Layout<Dim>& layout, const FaceField<Dim>& f, Site c) {
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = 0.5 * (f.at(a, c) + f.at(a, c + layout.stride(a)));
  return v;
}

}  // namespace

template <int Dim>
ConvectedPressure<Dim> convected_pressure(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                          const Participants<Dim>& participants, const StepGeometry<Dim>& g,
                                          const CellField<Dim>& phi, const Transported<Dim>& transported,
                                          double since) {
  ConvectedPressure<Dim> r;
  if (std::none_of(solids.bodies.begin(), solids.bodies.end(), carries_pressure<Dim>)) return r;
  std::vector<Placement> placed = g.placed;
  for (std::size_t k = 0; k < placed.size(); ++k) participants[k].set_velocity(placed[k]);
  r.value = CellField<Dim>(domain.layout);
  const FaceField<Dim>& of_gas =
      transported.gas_acceleration[0].empty() ? transported.acceleration : transported.gas_acceleration;
  for (const auto& [c, v] : velocities_at_cells(domain.layout, g, solids, placed)) {
    const bool wet = phi[c] < 0;
    if (v.weight == 0 || (!wet && !fluids.has_gas())) continue;
    const double density = wet ? fluids.density() : fluids.gas_density();
    const Vec<Dim> way = since / v.weight * v.sum;
    r.value[c] = 0.5 * density * way.dot(at_cell(domain.layout, wet ? transported.acceleration : of_gas, c));
  }
  domain.halo.fill_ghosts(r.value);
  r.loads = pressure_loads(domain, solids, g, r.value);
  for (std::size_t k = 0; k < r.loads.size(); ++k)
    if (!carries_pressure(solids.bodies[k])) r.loads[k] = {};  // cells beside it may touch one that does
  return r;
}

// dt A_f J'p
template <int Dim>
void push_by(const ConvectedPressure<Dim>& convected, const Domain<Dim>& domain, const PressureRows<Dim>& rows,
             double dt, SolidCoupling<Dim>& c) {
  if (!convected.any() || c.size() == 0) return;
  Vector p(rows.cells.size());
  for (std::size_t n = 0; n < rows.liquid; ++n) p[n] = convected.value[rows.cells[n]];
  const double impulse = dt * domain.layout.geometry().face_area();
  const Eigen::VectorXd load = multiply_transposed(c.J, p, domain.ranks);
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const int first = c.first[b], n = c.first[b + 1] - first;
    if (!c.J.blocks[b].deforms()) c.push.segment(first, n) += impulse * load.segment(first, n);
  }
}

#define SEICHE_INSTANTIATE(D)                                                                              \
  template ConvectedPressure<D> convected_pressure<D>(const Domain<D>&, const Fluids&, const Solids<D>&,   \
                                                      const Participants<D>&, const StepGeometry<D>&,      \
                                                      const CellField<D>&, const Transported<D>&, double); \
  template void push_by<D>(const ConvectedPressure<D>&, const Domain<D>&, const PressureRows<D>&, double,  \
                           SolidCoupling<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
