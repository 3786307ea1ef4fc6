#include "coupling/solve/rheology_iteration.h"

#include "base/scene.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/transport/transport.h"
#include "grid/loops.h"

namespace seiche {

template <int Dim>
RheologyIteration<Dim>::RheologyIteration(const Setup<Dim>& s, const State<Dim>& state, const TimeLevel<Dim>& flow)
    : setup_(s),
      state_(state),
      last_(flow.u),
      viscosity_(measure_viscosity(s.domain, s.fluids, s.perturbation, state, flow)) {}

template <int Dim>
bool RheologyIteration<Dim>::differs_from(const TimeLevel<Dim>& flow) {
  if (setup_.fluids.liquid.rheology.model.empty()) return false;
  ++count_;
  const FaceField<Dim, char> near = faces_near_liquid(setup_.domain, state_.phi);
  const FaceField<Dim>& u = flow.u;
  std::array<double, 2> largest{};  // difference, velocity
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(setup_.domain.layout, setup_.domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      if (!near.at(a, f)) return;
      largest[0] = std::max(largest[0], std::abs(u.at(a, f) - last_.at(a, f)));
      largest[1] = std::max(largest[1], std::abs(u.at(a, f)));
    });
  for (double& x : largest) x = setup_.domain.ranks.global_max(x);
  change_ = largest[1] > 0 ? largest[0] / largest[1] : 0;
  last_ = u;
  if (change_ <= setup_.scene->solver.rheology_tolerance || count_ >= setup_.scene->solver.rheology_iterations)
    return false;
  viscosity_ = measure_viscosity(setup_.domain, setup_.fluids, setup_.perturbation, state_, flow);
  return true;
}

template class RheologyIteration<2>;
template class RheologyIteration<3>;

}  // namespace seiche
