#include "coupling/transport/drifting.h"

#include "coupling/thin/gap_flow.h"
#include "coupling/transport/restore.h"
#include "fluid/transport/advection.h"
#include "fluid/volume/neighbours.h"
#include "grid/interpolation.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr double least_drop = 1e-6;  // share of a cell

// Calls body(axis, face) for the faces of cells.
template <int Dim, class Body>
void each_face_of(const Layout<Dim>& layout, const std::vector<Site>& cells, const Body& body) {
  for (const Site c : cells)
    for (int a = 0; a < Dim; ++a) body(a, c), body(a, c + layout.stride(a));
}

// Faces that solids close, or nearly so, let no drop fall: it would gain speed for as long as it stays.
template <int Dim>
bool may_fall(const FaceGeometry<Dim>& faces, int axis, Site face) {
  return faces.is_unknown(axis, face) && faces.open.at(axis, face) >= least_open;
}

// The velocities of the faces of a cell along an axis, after those that carry nothing out of it follow the other one.
// `leads`: a wall, or liquid comes through the face.
template <int Dim>
void join_faces(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& share, Site cell,
                int axis, FaceField<Dim>& u) {
  const Site step = domain.layout.stride(axis), top = cell + step;
  double &low = u.at(axis, cell), &high = u.at(axis, top);
  const bool low_leads = !may_fall(faces, axis, cell) || low < 0 || share[cell - step] > least_drop,
             high_leads = !may_fall(faces, axis, top) || high > 0 || share[top] > least_drop;
  if (low_leads && !high_leads) high = low;
  if (!low_leads && high_leads) low = high;
  if (!low_leads && !high_leads) low = high = 0.5 * (low + high);
}

}  // namespace

template <int Dim>
std::vector<Site> drifting_cells(const Domain<Dim>& domain, const CellField<Dim>& phi, const CellField<Dim>& share) {
  const Layout<Dim>& l = domain.layout;
  return listed_possible(
      l, cells_around(l, 1), [&](Site c) { return !all_zero(share.data() + c); },
      [&](Site c) {
        if (phi[c] < 0 || !(share[c] > least_drop)) return false;
        for (int n = 0; n < neighbour_count<Dim>(); ++n)
          if (phi[c + step_of(l, neighbour_offset<Dim>(n))] < 0) return false;
        return true;
      });
}

template <int Dim>
void mark_faces(const Layout<Dim>& layout, const std::vector<Site>& drifting, FaceField<Dim, char>& marks) {
  each_face_of(layout, drifting, [&](int a, Site f) { marks.at(a, f) = 1; });
}

template <int Dim>
double falling_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec3& gravity, double dt, int axis,
                        Site face) {
  const Vec<Dim> from = departure_of_face(layout, u, axis, face, layout.index(face), dt);
  return interpolate_linear<Dim>(layout, u[axis].data(), index_coordinates<Dim>(layout, from, face_offset<Dim>(axis))) +
         dt * gravity[axis];
}

template <int Dim>
void let_drift(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& share,
               const std::vector<Site>& drifting, const FaceField<Dim>& u, const Vec3& gravity, double dt,
               FaceField<Dim>& u_star) {
  if (!domain.ranks.any(!drifting.empty())) return;
  const Layout<Dim>& l = domain.layout;
  each_face_of(l, drifting, [&](int a, Site f) {
    if (!faces.is_unknown(a, f)) return;
    u_star.at(a, f) = !may_fall(faces, a, f) ? 0 : falling_velocity(l, u, gravity, dt, a, f);
  });
  for (const Site c : drifting)
    for (int a = 0; a < Dim; ++a) join_faces(domain, faces, share, c, a, u_star);
  fill_velocity_ghosts(l, domain.halo, domain.sides, u_star);
}

template <int Dim>
void take_drifting(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const std::vector<Site>& drifting,
                   const FaceField<Dim>& u_star, TimeLevel<Dim>& level) {
  if (!domain.ranks.any(!drifting.empty())) return;
  each_face_of(domain.layout, drifting, [&](int a, Site f) {
    if (level.valid.at(a, f) || !may_fall(faces, a, f)) return;
    level.valid.at(a, f) = face_at_surface;
    level.u.at(a, f) = u_star.at(a, f);
  });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, level.u);
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template std::vector<Site> drifting_cells<D>(const Domain<D>&, const CellField<D>&, const CellField<D>&);           \
  template void mark_faces<D>(const Layout<D>&, const std::vector<Site>&, FaceField<D, char>&);                       \
  template double falling_velocity<D>(const Layout<D>&, const FaceField<D>&, const Vec3&, double, int, Site);         \
  template void let_drift<D>(const Domain<D>&, const FaceGeometry<D>&, const CellField<D>&, const std::vector<Site>&, \
                             const FaceField<D>&, const Vec3&, double, FaceField<D>&);                                \
  template void take_drifting<D>(const Domain<D>&, const FaceGeometry<D>&, const std::vector<Site>&,                  \
                                 const FaceField<D>&, TimeLevel<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
