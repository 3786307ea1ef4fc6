#include "coupling/sealed_liquid.h"

#include "grid/loops.h"
#include "levelset/redistance.h"
#include "solid/enclosed_volume.h"

namespace seiche {
namespace {

// Cells: how deep in the wall the surface of sealed liquid lies at least, so that no shift of phi brings it out.
constexpr double depth = 2;

template <int Dim>
bool has_corner_inside(const Layout<Dim>& layout, const NodeField<Dim>& distance, Site cell) {
  for (int k = 0; k < (1 << Dim); ++k) {
    Site node = cell;
    for (int a = 0; a < Dim; ++a) node += ((k >> a) & 1) * layout.stride(a);
    if (distance[node] < 0) return true;
  }
  return false;
}

// Whether enclosed air that keeps its volume has its centre well within. Collective.
template <int Dim>
bool holds_air(const Setup<Dim>& s, const AirRegions<Dim>& air, const NodeField<Dim>& distance, const Box<Dim>& cells) {
  if (!s.keeps_air()) return false;
  bool any = false;
  for_each_index_in_order(s.layout, cells, [&](Site c, const IVec<Dim>&) {
    any = any || (air.label[c] >= 0 && distance[c] < -s.layout.h());
  });
  return s.ranks.any(any);
}

template <int Dim>
void fill_cavity(const Setup<Dim>& s, const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u,
                 const AirRegions<Dim>& air, CellField<Dim>& phi) {
  const SurfaceMesh wall = wall_of_cavity(solid, part);
  const std::vector<Vec<Dim>> points = surface_points(solid, u);
  const SurfaceDistance<Dim> surface(s.layout, wall, points);
  NodeField<Dim> distance(s.layout, 1e30);
  surface.fill(distance);
  const Box<Dim> cells = s.layout.cells().cut({surface.box().lower, surface.box().upper.array() - 1});
  if (holds_air(s, air, distance, cells)) return;
  for_each_site(s.layout, cells, [&](Site c) {
    if (has_corner_inside(s.layout, distance, c)) phi[c] = std::min(phi[c], distance[c] - depth * s.layout.h());
  });
}

}  // namespace

template <int Dim>
void keep_sealed_full(const Setup<Dim>& s, const State<Dim>& before, const State<Dim>& after, CellField<Dim>& phi) {
  bool any = false;
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    if (!s.bodies[k].is_elastic()) continue;
    const Eigen::VectorXd &kept = before.elastic[k].kept_volume, &u = after.elastic[k].state.u;
    for (int part = 0; part < int(kept.size()); ++part) {
      if (!std::isfinite(kept[part]) || kept[part] >= 0) continue;
      fill_cavity(s, s.bodies[k].elastic(), part, u, before.air, phi);
      any = true;
    }
  }
  if (any) fill_level_set_ghosts(s.layout, s.halo, phi);
}

template void keep_sealed_full<2>(const Setup<2>&, const State<2>&, const State<2>&, CellField<2>&);
template void keep_sealed_full<3>(const Setup<3>&, const State<3>&, const State<3>&, CellField<3>&);

}  // namespace seiche
