#include "coupling/solids/pressure_loads.h"

namespace seiche {
namespace {

// This rank's part.
template <int Dim>
SolidLoad local_load(const Layout<Dim>& layout, const CellField<Dim>& p, const FaceShares& shares, const Vec3& about) {
  SolidLoad load;
  for (const FaceShare& share : shares) {
    const double jump = p[share.face - layout.stride(share.axis)] - p[share.face];
    const IVec<Dim> i = layout.index(share.face);
    if (jump == 0 || !layout.faces(share.axis).contains(i)) continue;
    Vec3 force = Vec3::Zero();
    force[share.axis] = share.closed * layout.geometry().face_area() * jump;
    load.force += force;
    load.torque += (extend<Dim>(layout.position(i, face_offset<Dim>(share.axis))) - about).cross(force);
  }
  return load;
}

}  // namespace

template <int Dim>
std::vector<SolidLoad> pressure_loads(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                                      const CellField<Dim>& p) {
  std::vector<double> sums;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    const Vec3 reference = g.placed[k].pose.apply(solids.bodies[k].reference_point());
    const SolidLoad load =
        local_load(domain.layout, p, *g.shares[k], g.deforms(int(k)) ? reference : Vec3(g.pivots[k]));
    for (const Vec3& v : {load.force, load.torque}) sums.insert(sums.end(), v.begin(), v.end());
  }
  if (!sums.empty()) domain.ranks.global_sum(sums);
  std::vector<SolidLoad> loads(solids.bodies.size());
  for (std::size_t k = 0; k < loads.size(); ++k) loads[k] = {Vec3(&sums[6 * k]), Vec3(&sums[6 * k + 3])};
  return loads;
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template std::vector<SolidLoad> pressure_loads<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, \
                                                    const CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
