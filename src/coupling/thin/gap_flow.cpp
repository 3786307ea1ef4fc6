#include "coupling/thin/gap_flow.h"

#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Less open than least_open, and so are its neighbours on both sides across some axis: solids or walls are near there.
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

template <int Dim>
GapFlow<Dim> measure_gap_flow(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FaceField<Dim>& solved,
                              const FaceField<Dim>& continued) {
  GapFlow<Dim> gap_flow{faces.open, continued};
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (faces.open.at(a, f) < least_open) gap_flow.u.at(a, f) = solved.at(a, f);
    });
  return gap_flow;
}

// With w u^2 kept a plate of width L lifted from a floor obeys (v/delta)' = F/k - (v/delta)^2/2, k = rho L^3/12, as it
// does in inviscid liquid that comes in from rest.
template <int Dim>
void set_gap_velocity(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const GapFlow<Dim>& gap_flow,
                      const Vec3& g, double dt, FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    for_each_index(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      const double before = gap_flow.open.at(a, f), open = faces.open.at(a, f);
      if (open <= before || !is_slit(domain.layout, faces, a, f, i)) return;
      u.at(a, f) = gap_flow.u.at(a, f) * std::sqrt(before / open) + dt * g[a];
    });
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template GapFlow<D> measure_gap_flow<D>(const Domain<D>&, const FaceGeometry<D>&, const FaceField<D>&,              \
                                          const FaceField<D>&);                                                       \
  template void set_gap_velocity<D>(const Domain<D>&, const FaceGeometry<D>&, const GapFlow<D>&, const Vec3&, double, \
                                    FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
