#include "coupling/solve/rheology_iteration.h"

#include <cmath>
#include <utility>

#include "base/scene.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/transport/transport.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// to <- sqrt(from to)
template <int Dim>
void go_half_way(const Layout<Dim>& layout, const ViscosityField<Dim>& from, ViscosityField<Dim>& to) {
  for_each_site(layout, layout.padded(), [&](Site c) { to.value[c] = std::sqrt(from.value[c] * to.value[c]); });
  for (int p = 0; to.edge && p < EdgeField<Dim>::count; ++p)
    for_each_site(layout, layout.padded(),
                  [&](Site c) { (*to.edge)[p][c] = std::sqrt((*from.edge)[p][c] * (*to.edge)[p][c]); });
  to.largest = std::sqrt(from.largest * to.largest);
}

}  // namespace

template <int Dim>
RheologyIteration<Dim>::RheologyIteration(const Setup<Dim>& s, const State<Dim>& state, const TimeLevel<Dim>& flow)
    : setup_(s),
      state_(state),
      last_(flow.u),
      viscosity_(measure_viscosity(s.domain, s.fluids, s.perturbation, state, flow)) {}

template <int Dim>
bool RheologyIteration<Dim>::differs_from(const TimeLevel<Dim>& flow, bool friction_settled) {
  if (setup_.fluids.liquid.rheology.model.empty()) return false;
  ++count_;
  const FaceField<Dim, char> near = faces_near_liquid(setup_.domain, state_.phi);
  const FaceField<Dim>& u = flow.u;
  std::array<double, 2> largest{};  // difference, velocity
  double along = 0;                 // of this change and the one before
  if (count_ == 1) way_ = FaceField<Dim>(setup_.domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(setup_.domain.layout, setup_.domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      if (!near.at(a, f)) return;
      const double way = u.at(a, f) - last_.at(a, f);
      along += way * way_.at(a, f);
      way_.at(a, f) = way;
      largest[0] = std::max(largest[0], std::abs(way));
      largest[1] = std::max(largest[1], std::abs(u.at(a, f)));
    });
  for (double& x : largest) x = setup_.domain.ranks.global_max(x);
  swings_ = swings_ || setup_.domain.ranks.global_sum(along) < 0;
  const double before = std::exchange(change_, largest[1] > 0 ? largest[0] / largest[1] : 0);
  last_ = u;
  if (change_ <= setup_.scene->solver.rheology_tolerance || count_ >= setup_.scene->solver.rheology_iterations)
    return false;
  if (!friction_settled && count_ > 1 && change_ >= before) return false;
  ViscosityField<Dim> next = measure_viscosity(setup_.domain, setup_.fluids, setup_.perturbation, state_, flow);
  if (swings_) go_half_way(setup_.domain.layout, viscosity_, next);
  viscosity_ = std::move(next);
  return true;
}

template <int Dim>
double RheologyIteration<Dim>::change_left() const {
  return change_ <= setup_.scene->solver.rheology_tolerance ? 0 : change_;
}

template class RheologyIteration<2>;
template class RheologyIteration<3>;

}  // namespace seiche
