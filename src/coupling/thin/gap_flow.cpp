#include "coupling/thin/gap_flow.h"

#include <algorithm>

#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Calls body(face, index) in order for the owned faces less open than least_open. Faces are open where nothing is
// stored.
template <int Dim, class Body>
void for_each_narrow(const Layout<Dim>& layout, const FaceGeometry<Dim>& faces, int axis, const Body& body) {
  const Box<Dim> owned = layout.faces(axis);
  faces.open[axis].for_each_stored([&](Site f, double open) {
    if (open >= least_open) return;
    if (const IVec<Dim> i = layout.index(f); owned.contains(i)) body(f, i);
  });
}

// True for an open face in a slit: it and both neighbours along some other axis are less open than least_open. Walls of
// the domain count as such neighbours.
template <int Dim>
bool is_slit(const Layout<Dim>& layout, const FaceGeometry<Dim>& faces, int axis, Site f, const IVec<Dim>& i) {
  if (faces.kind_at(axis, f) != FaceKind::open || faces.open.at(axis, f) >= least_open) return false;
  const Geometry<Dim>& g = layout.geometry();
  for (int k = 1; k < Dim; ++k) {
    const int b = (axis + k) % Dim;
    const Site d = layout.stride(b);
    const bool low_wall = !g.periodic[b] && i[b] == 0, high_wall = !g.periodic[b] && i[b] == g.cells[b] - 1;
    if ((low_wall || faces.open.at(axis, f - d) < least_open) && (high_wall || faces.open.at(axis, f + d) < least_open))
      return true;
  }
  return false;
}

}  // namespace

double share_of_slow(double way) {
  return std::clamp((fast_way - way) / (fast_way - slow_way), 0.0, 1.0);
}

template <int Dim>
GapFlow<Dim> measure_gap_flow(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FaceField<Dim>& solved) {
  GapFlow<Dim> gap_flow(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_narrow(domain.layout, faces, a, [&](Site f, const IVec<Dim>&) {
      gap_flow.open.set(a, f, faces.open.at(a, f));
      gap_flow.u.set(a, f, solved.at(a, f));
    });
  return gap_flow;
}

// A plate of width L lifts off a floor with (v/delta)' = F/k - (v/delta)^2/2, k = rho L^3/12, if w u^2 is conserved.
// This is the exact law for inviscid liquid that enters from rest.
template <int Dim>
void set_gap_velocity(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const GapFlow<Dim>& gap_flow,
                      const Vec3& g, double dt, FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    for_each_narrow(domain.layout, faces, a, [&](Site f, const IVec<Dim>& i) {
      const double before = gap_flow.open.at(a, f), open = faces.open.at(a, f);
      if (open <= before || !is_slit(domain.layout, faces, a, f, i)) return;
      u.at(a, f) = gap_flow.u.at(a, f) * std::sqrt(before / open) + dt * g[a];
    });
}

template <int Dim>
void keep_inertia_in_gaps(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const GapFlow<Dim>& gap_flow,
                          const std::function<bool(int, Site)>& wanted, const Vec3& g, double dt, FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    for_each_narrow(domain.layout, faces, a, [&](Site f, const IVec<Dim>& i) {
      const double widened = faces.open.at(a, f) - gap_flow.open.at(a, f), last = gap_flow.u.at(a, f);
      if (last == 0 || faces.kind_at(a, f) != FaceKind::open || !wanted(a, f)) return;
      if (widened > 0 && is_slit(domain.layout, faces, a, f, i)) return;
      const double own = last + dt * g[a], fastest = std::max(std::abs(last), std::abs(u.at(a, f) - dt * g[a]));
      const double way = std::max(fastest * dt / domain.layout.h(), std::abs(widened));
      u.at(a, f) += share_of_slow(way) * (own - u.at(a, f));
    });
}

template <int Dim>
void let_surface_through_gaps(const Domain<Dim>& domain, const GapFlow<Dim>& gap_flow, const CellField<Dim>& phi,
                              const FaceField<Dim, char>& valid, double dt, FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    gap_flow.open[a].for_each_stored([&](Site f, double open) {
      if (open >= least_open || valid.at(a, f) || (phi[f] < 0) == (phi[f - domain.layout.stride(a)] < 0)) return;
      const double own = gap_flow.u.at(a, f) * open / least_open;
      const double way = std::max(std::abs(own), std::abs(u.at(a, f))) * dt / domain.layout.h();
      u.at(a, f) += share_of_slow(way) * (own - u.at(a, f));
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, u);
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template GapFlow<D> measure_gap_flow<D>(const Domain<D>&, const FaceGeometry<D>&, const FaceField<D>&);             \
  template void set_gap_velocity<D>(const Domain<D>&, const FaceGeometry<D>&, const GapFlow<D>&, const Vec3&, double, \
                                    FaceField<D>&);                                                                   \
  template void keep_inertia_in_gaps<D>(const Domain<D>&, const FaceGeometry<D>&, const GapFlow<D>&,                  \
                                        const std::function<bool(int, Site)>&, const Vec3&, double, FaceField<D>&);   \
  template void let_surface_through_gaps<D>(const Domain<D>&, const GapFlow<D>&, const CellField<D>&,                 \
                                            const FaceField<D, char>&, double, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
