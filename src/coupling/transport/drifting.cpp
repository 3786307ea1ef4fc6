#include "coupling/transport/drifting.h"

#include "fluid/transport/advection.h"
#include "fluid/volume/neighbours.h"
#include "grid/interpolation.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr double least_drop = 1e-6;  // share of a cell

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
double falling_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec3& gravity, double dt, int axis,
                        Site face) {
  const Vec<Dim> from = departure_of_face(layout, u, axis, face, layout.index(face), dt);
  return interpolate_linear<Dim>(layout, u[axis].data(), index_coordinates<Dim>(layout, from, face_offset<Dim>(axis))) +
         dt * gravity[axis];
}

#define SEICHE_INSTANTIATE(D)                                                                               \
  template std::vector<Site> drifting_cells<D>(const Domain<D>&, const CellField<D>&, const CellField<D>&); \
  template double falling_velocity<D>(const Layout<D>&, const FaceField<D>&, const Vec3&, double, int, Site);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
