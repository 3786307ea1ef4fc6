#include "coupling/transport/beside_solids.h"

#include "grid/loops.h"
#include "levelset/extrapolate.h"

namespace seiche {

template <int Dim>
FaceDistance<Dim> distance_at_face(const Layout<Dim>& layout, const NodeField<Dim>& psi, int axis, Site face) {
  constexpr int corners = 1 << (Dim - 1);
  FaceDistance<Dim> r;
  for (int k = 0; k < corners; ++k) {
    Site node = face;
    for (int b = 1; b < Dim; ++b) node += ((k >> (b - 1)) & 1) * layout.stride((axis + b) % Dim);
    r.psi += psi[node] / corners;
    r.gradient[axis] += (psi[node + layout.stride(axis)] - psi[node - layout.stride(axis)]) / (2 * corners);
    for (int b = 1; b < Dim; ++b)
      r.gradient[(axis + b) % Dim] += (((k >> (b - 1)) & 1) ? 1 : -1) * psi[node] * 2 / corners;
  }
  return r;
}

template <int Dim>
FaceField<Dim, char> faces_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                         const StepGeometry<Dim>& g, const FaceField<Dim, char>& near) {
  constexpr double reach = 2;  // cells
  FaceField<Dim, char> beside(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), near[a].data(), [&](Site f) {
      if (g.body[f] < 0) return;
      if (distance_at_face(domain.layout, g.psi, a, f).psi >= reach * domain.layout.h()) return;
      beside.at(a, f) = g.continues_flow(g.body[f]) && !solids.bodies[std::size_t(g.body[f])].is_thin();
    });
  return beside;
}

template <int Dim>
void continue_beyond(const Domain<Dim>& domain, const FaceField<Dim, char>& valid, FaceField<Dim>& f) {
  for (int a = 0; a < Dim; ++a) {
    FieldValues<char> known = valid[a];
    extrapolate(domain.layout, domain.halo, domain.layout.faces(a), {domain.extrapolated_layers(), 2}, f[a], known);
  }
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, f);
}

#define SEICHE_INSTANTIATE(D)                                                                                    \
  template FaceDistance<D> distance_at_face<D>(const Layout<D>&, const NodeField<D>&, int, Site);                \
  template FaceField<D, char> faces_beside_solids<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, \
                                                     const FaceField<D, char>&);                                 \
  template void continue_beyond<D>(const Domain<D>&, const FaceField<D, char>&, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
