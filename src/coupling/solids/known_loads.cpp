#include "coupling/solids/known_loads.h"

namespace seiche {

template <int Dim>
void push_by(const std::vector<SolidLoad>& loads, const Participants<Dim>& solids, const StepGeometry<Dim>& g,
             double dt, SolidCoupling<Dim>& c) {
  if (loads.empty()) return;
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const auto k = std::size_t(c.bodies[b]);
    if (g.deforms(int(k))) continue;
    const Participant<Dim>& solid = solids[k];
    const Vec3 reference = g.placed[k].pose.apply(solid.body().reference_point());
    const Vec3 center = solid.rigid() ? solid.rigid()->center : reference;
    const Vec3 torque = loads[k].torque + (reference - center).cross(loads[k].force);
    Eigen::VectorXd impulse = solid.generalised({dt * loads[k].force, dt * torque});
    for (Eigen::Index i = 0; i < impulse.size(); ++i)
      if (c.is_held(c.first[b] + i)) impulse[i] = 0;
    c.push.segment(c.first[b], impulse.size()) += impulse;
  }
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template void push_by<D>(const std::vector<SolidLoad>&, const Participants<D>&, const StepGeometry<D>&, double, \
                           SolidCoupling<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
