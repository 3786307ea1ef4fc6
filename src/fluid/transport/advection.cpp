#include "fluid/transport/advection.h"

#include "fluid/transport/medial_axis.h"
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

namespace {

// Mean over the faces around a cell or face centre. Second order is enough for the first half of a midpoint step.
template <int Dim>
Vec<Dim> mean_at_cell(const Layout<Dim>& layout, const FaceField<Dim>& u, Site c) {
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = 0.5 * (u.at(a, c) + u.at(a, c + layout.stride(a)));
  return v;
}

template <int Dim>
Vec<Dim> mean_at_face(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site f) {
  Vec<Dim> v;
  const Site d = layout.stride(axis);
  for (int a = 0; a < Dim; ++a) {
    const Site up = layout.stride(a);
    v[a] = a == axis ? u.at(a, f) : 0.25 * (u.at(a, f) + u.at(a, f + up) + u.at(a, f - d) + u.at(a, f + up - d));
  }
  return v;
}

}  // namespace

template <int Dim>
Vec<Dim> trace_midpoint(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& at_x, const Vec<Dim>& x,
                        double dt) {
  return x - dt * sample_velocity<Dim>(layout, u, x - 0.5 * dt * at_x);
}

template <int Dim>
Vec<Dim> trace_third_order(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& at_x, const Vec<Dim>& x,
                           double dt) {
  const Vec<Dim> third = sample_velocity<Dim>(layout, u, x - dt / 3 * at_x);
  const Vec<Dim> two_thirds = sample_velocity<Dim>(layout, u, x - 2 * dt / 3 * third);
  return x - 0.25 * dt * (at_x + 3 * two_thirds);
}

template <int Dim>
Vec<Dim> departure_of_face(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site f, const IVec<Dim>& i,
                           double dt) {
  return trace_midpoint<Dim>(layout, u, mean_at_face(layout, u, axis, f), layout.position(i, face_offset<Dim>(axis)),
                             dt);
}

template <int Dim>
void advect_level_set(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, double band,
                      const CellField<Dim>& phi, CellField<Dim>& moved, const LevelSetTransport& how) {
  for_each_index(layout, layout.cells(), [&](Site s, const IVec<Dim>& i) {
    moved[s] = phi[s];
    if (std::abs(phi[s]) >= band) return;
    const Vec<Dim> x = layout.position(i, cell_offset<Dim>()), at_x = mean_at_cell(layout, u, s);
    const Vec<Dim> from = how.trace == Trace::midpoint ? trace_midpoint<Dim>(layout, u, at_x, x, dt)
                                                       : trace_third_order<Dim>(layout, u, at_x, x, dt);
    const Vec<Dim> g = index_coordinates<Dim>(layout, from, cell_offset<Dim>());
    moved[s] = how.one_sided_at_medial_axis ? interpolate_beside_medial_axis<Dim>(layout, phi.data(), g)
                                            : interpolate_cubic<Dim>(layout, phi.data(), g);
  });
}

template <int Dim>
void advect_faces(const Layout<Dim>& layout, const FaceField<Dim>& path, double dt, const FaceField<Dim, char>& near,
                  const FaceField<Dim, char>& interior, const FaceField<Dim>& inner, const FaceField<Dim>& outer,
                  FaceField<Dim>& result, Interpolation interpolation) {
  const bool six = interpolation == Interpolation::six_points;
  for (int a = 0; a < Dim; ++a)
    for_each_marked_index(layout, layout.faces(a), near[a].data(), [&](Site s, const IVec<Dim>& i) {
      const Vec<Dim> from = departure_of_face(layout, path, a, s, i, dt);
      const bool inside = interior.at(a, s);
      const double* carried = inside ? inner[a].data() : outer[a].data();
      const Vec<Dim> g = index_coordinates<Dim>(layout, from, face_offset<Dim>(a));
      result.at(a, s) =
          six && inside ? interpolate_quintic<Dim>(layout, carried, g) : interpolate_cubic<Dim>(layout, carried, g);
    });
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template Vec<D> sample_velocity<D>(const Layout<D>&, const FaceField<D>&, const Vec<D>&);                          \
  template Vec<D> trace_midpoint<D>(const Layout<D>&, const FaceField<D>&, const Vec<D>&, const Vec<D>&, double);    \
  template Vec<D> trace_third_order<D>(const Layout<D>&, const FaceField<D>&, const Vec<D>&, const Vec<D>&, double); \
  template Vec<D> departure_of_face<D>(const Layout<D>&, const FaceField<D>&, int, Site, const IVec<D>&, double);    \
  template void advect_level_set<D>(const Layout<D>&, const FaceField<D>&, double, double, const CellField<D>&,      \
                                    CellField<D>&, const LevelSetTransport&);                                        \
  template void advect_faces<D>(const Layout<D>&, const FaceField<D>&, double, const FaceField<D, char>&,            \
                                const FaceField<D, char>&, const FaceField<D>&, const FaceField<D>&, FaceField<D>&,  \
                                Interpolation);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
