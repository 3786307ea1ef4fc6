#include "fluid/advection.h"

#include "grid/interpolation.h"
#include "grid/loops.h"

namespace seiche {

template <int Dim>
Vec<Dim> sample_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& x) {
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a)
    v[a] = interpolate_cubic<Dim>(layout, u[a].data(), index_coordinates<Dim>(layout, x, face_offset<Dim>(a)));
  return v;
}

// x_d = x - dt u(x - dt/2 u(x)).
template <int Dim>
Vec<Dim> trace_midpoint(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& x, double dt) {
  const Vec<Dim> middle = x - 0.5 * dt * sample_velocity(layout, u, x);
  return x - dt * sample_velocity(layout, u, middle);
}

// Ralston 1962: k1 = u(x), k2 = u(x - dt/2 k1), k3 = u(x - 3/4 dt k2); x_d = x - dt (2 k1 + 3 k2 + 4 k3)/9.
template <int Dim>
Vec<Dim> trace_third_order(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& x, double dt) {
  const Vec<Dim> k1 = sample_velocity(layout, u, x);
  const Vec<Dim> k2 = sample_velocity<Dim>(layout, u, x - 0.5 * dt * k1);
  const Vec<Dim> k3 = sample_velocity<Dim>(layout, u, x - 0.75 * dt * k2);
  return x - dt / 9 * (2 * k1 + 3 * k2 + 4 * k3);
}

template <int Dim>
void advect_level_set(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, double band, const CellField<Dim>& phi,
                      CellField<Dim>& moved) {
  for_each_index(layout, layout.cells(), [&](Site s, const IVec<Dim>& i) {
    moved[s] = phi[s];
    if (std::abs(phi[s]) >= band) return;
    const Vec<Dim> from = trace_third_order<Dim>(layout, u, layout.position(i, cell_offset<Dim>()), dt);
    moved[s] = interpolate_cubic<Dim>(layout, phi.data(), index_coordinates<Dim>(layout, from, cell_offset<Dim>()));
  });
}

template <int Dim>
void advect_faces(const Layout<Dim>& layout, const FaceField<Dim>& path, double dt, const FaceField<Dim, char>& near,
                  const FaceField<Dim>& carried, FaceField<Dim>& result) {
  for (int a = 0; a < Dim; ++a)
    for_each_index(layout, layout.faces(a), [&](Site s, const IVec<Dim>& i) {
      if (!near.at(a, s)) return;
      const Vec<Dim> from = trace_midpoint<Dim>(layout, path, layout.position(i, face_offset<Dim>(a)), dt);
      result.at(a, s) =
          interpolate_cubic<Dim>(layout, carried[a].data(), index_coordinates<Dim>(layout, from, face_offset<Dim>(a)));
    });
}

#define SEICHE_INSTANTIATE(D)                                                                                       \
  template Vec<D> sample_velocity<D>(const Layout<D>&, const FaceField<D>&, const Vec<D>&);                         \
  template Vec<D> trace_midpoint<D>(const Layout<D>&, const FaceField<D>&, const Vec<D>&, double);                  \
  template Vec<D> trace_third_order<D>(const Layout<D>&, const FaceField<D>&, const Vec<D>&, double);               \
  template void advect_level_set<D>(const Layout<D>&, const FaceField<D>&, double, double, const CellField<D>&,     \
                                    CellField<D>&);                                                                 \
  template void advect_faces<D>(const Layout<D>&, const FaceField<D>&, double, const FaceField<D, char>&,           \
                                const FaceField<D>&, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
