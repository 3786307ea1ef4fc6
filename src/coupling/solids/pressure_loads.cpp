#include "coupling/solids/pressure_loads.h"

#include "fluid/viscosity/load_sums.h"

namespace seiche {
namespace {

// Adds this rank's part of the load on solid k.
template <int Dim>
void add_pressure_load(const Layout<Dim>& layout, const CellField<Dim>& p, const FaceShares& shares, int k,
                       LoadSums& sums) {
  for (const FaceShare& share : shares) {
    const double jump = p[share.face - layout.stride(share.axis)] - p[share.face];
    const IVec<Dim> i = layout.index(share.face);
    if (jump == 0 || !layout.faces(share.axis).contains(i)) continue;
    sums.add(k, extend<Dim>(layout.position(i, face_offset<Dim>(share.axis))),
             share.closed * layout.geometry().face_area() * jump * Vec3::Unit(share.axis));
  }
}

}  // namespace

template <int Dim>
std::vector<SolidLoad> pressure_loads(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                                      const CellField<Dim>& p) {
  std::vector<Vec3> about;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    about.push_back(g.deforms(int(k)) ? g.placed[k].pose.apply(solids.bodies[k].reference_point()) : g.pivots[k]);
  LoadSums sums(about);
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    add_pressure_load(domain.layout, p, *g.shares[k], int(k), sums);
  return sums.total(domain.ranks);
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template std::vector<SolidLoad> pressure_loads<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, \
                                                    const CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
