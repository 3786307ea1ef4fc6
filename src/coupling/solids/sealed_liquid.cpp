#include "coupling/solids/sealed_liquid.h"

#include "coupling/solids/kind_elastic.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/redistance.h"
#include "solid/body/enclosed_volume.h"

namespace seiche {
namespace {

// The surface of sealed liquid lies at least this many cells inside the wall, so that no shift of phi exposes it.
constexpr double sealed_depth = 2;

template <int Dim>
bool has_corner_inside(const Layout<Dim>& layout, const NodeField<Dim>& distance, Site cell) {
  for (int k = 0; k < (1 << Dim); ++k) {
    Site node = cell;
    for (int a = 0; a < Dim; ++a) node += ((k >> a) & 1) * layout.stride(a);
    if (distance[node] < 0) return true;
  }
  return false;
}

// True if a cell beyond the surface that has a pressure lies more than h inside the cavity. Collective.
template <int Dim>
bool holds_air(const Domain<Dim>& domain, const Exterior<Dim>& exterior, const NodeField<Dim>& distance,
               const Box<Dim>& cells) {
  bool any = false;
  for_each_index_in_order(domain.layout, cells, [&](Site c, const IVec<Dim>&) {
    any = any || (exterior.has_pressure(c) && distance[c] < -domain.layout.h());
  });
  return domain.ranks.any(any);
}

template <int Dim>
void fill_cavity(const Domain<Dim>& domain, const ElasticSolid<Dim>& solid, int patch, const Eigen::VectorXd& u,
                 const Exterior<Dim>& exterior, CellField<Dim>& phi) {
  const SurfaceMesh wall = wall_of_cavity(solid, patch);
  const std::vector<Vec<Dim>> points = surface_points(solid, u);
  const SurfaceDistance<Dim> surface(domain.layout, wall, points);
  NodeField<Dim> distance(domain.layout, 1e30);
  surface.fill(distance);
  const Box<Dim> cells = domain.layout.cells().cut({surface.box().lower, surface.box().upper.array() - 1});
  if (holds_air(domain, exterior, distance, cells)) return;
  for_each_site(domain.layout, cells, [&](Site c) {
    if (has_corner_inside(domain.layout, distance, c))
      phi[c] = std::min(phi[c], distance[c] - sealed_depth * domain.layout.h());
  });
}

// Fills cells that were sealed, and their neighbours across open faces, since walls move by less than a cell. These
// neighbours are cut, with centres up to most of a cell inside the wall. With phi = -h the surface lies deep enough.
template <int Dim>
void fill_marked(const Domain<Dim>& domain, const CellField<Dim, char>& sealed, const FaceGeometry<Dim>& faces,
                 CellField<Dim>& phi) {
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    bool full = sealed[c] != 0;
    for (int a = 0; a < Dim; ++a) {
      const Site d = domain.layout.stride(a);
      full = full || (sealed[c - d] && faces.open.at(a, c) > 0) || (sealed[c + d] && faces.open.at(a, c + d) > 0);
    }
    if (full) phi[c] = std::min(phi[c], -domain.layout.h());
  });
}

}  // namespace

template <int Dim>
void keep_sealed_full(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& before,
                      const State<Dim>& after, const StepGeometry<Dim>& g, CellField<Dim>& phi) {
  bool any = solids.may_seal();
  if (any) fill_marked(domain, before.sealed, g.faces, phi);
  const ElasticMotions old = elastic_motions(before.solids), now = elastic_motions(after.solids);
  for (std::size_t k = 0; k < old.size(); ++k) {
    if (!old[k]) continue;
    const ElasticSolid<Dim>& solid = solids.bodies[k].elastic();
    const Eigen::VectorXd& cavity = old[k]->cavity;
    for (int p = 0; p < int(cavity.size()); ++p) {
      if (!(cavity[p] >= 0) || !solid.patches[std::size_t(p)].is_closed()) continue;
      if (!is_vessel<Dim>({&solid, int(k), p}, old[k]->state.u)) continue;
      fill_cavity(domain, solid, p, now[k]->state.u, *before.exterior, phi);
      any = true;
    }
  }
  if (any) fill_level_set_ghosts(domain.layout, domain.halo, phi);
}

template <int Dim>
void mark_sealed(const Domain<Dim>& domain, const Solids<Dim>& solids, const PressureRows<Dim>& rows,
                 const std::vector<CavityConstraint<Dim>>& cavities, State<Dim>& state) {
  if (!solids.may_seal()) return;
  state.sealed = CellField<Dim, char>(domain.layout);
  for (const CavityConstraint<Dim>& cavity : cavities)
    for (const int n : cavity.cells) state.sealed[rows.cells[std::size_t(n)]] = 1;
  domain.halo.fill_ghosts({state.sealed.data()});
}

#define SEICHE_INSTANTIATE(D)                                                                             \
  template void keep_sealed_full<D>(const Domain<D>&, const Solids<D>&, const State<D>&, const State<D>&, \
                                    const StepGeometry<D>&, CellField<D>&);                               \
  template void mark_sealed<D>(const Domain<D>&, const Solids<D>&, const PressureRows<D>&,                \
                               const std::vector<CavityConstraint<D>>&, State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
