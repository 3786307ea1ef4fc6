#include "coupling/solids/rebound.h"

#include <algorithm>
#include <utility>

#include "coupling/solids/impact_search.h"
#include "coupling/state/solids.h"
#include "solid/contact/reflections.h"

namespace seiche {
namespace {

template <int Dim>
class Rebounds : public Interaction<Dim> {
 public:
  double driven_work(const State<Dim>& state, double) const override {
    double work = 0;
    for (const Impact& impact : state.impacts) work += impact.work;
    return work;
  }
};

// The rebounds that are due, together: impulses of all unknowns, what they do to the pairs.
struct DueRebounds {
  Eigen::VectorXd push;
  double slope = 0;     // their impulses times the mean speeds at which the pairs part without them, J
  double response = 0;  // sum of Impact::response
  double energy = 0;    // that they may give back, J
  bool any = false;
};

template <int Dim>
DueRebounds due_rebounds(const Impacts& impacts, const ImpactColumns<Dim>& columns, const Eigen::VectorXd& before,
                         const Eigen::VectorXd& alone) {
  DueRebounds all;
  all.push.setZero(alone.size());
  for (const Impact& impact : impacts) {
    if (impact.stage != Impact::Stage::due) continue;
    const ImpactColumn column = columns.column(impact.first, impact.second, impact.impulses);
    const double impulse = impact.share * column.size;
    column.add_to(all.push, impulse);
    all.slope += 0.5 * impulse * (column.parting(before) + column.parting(alone));
    all.response += impact.response;
    all.energy += impact.energy;
    all.any = true;
  }
  return all;
}

}  // namespace

template <int Dim>
ImpactsOfSolve<Dim>::ImpactsOfSolve(const Setup<Dim>& setup, const State<Dim>& state,
                                    const SolidCoupling<Dim>& coupling, double horizon)
    : setup_(setup), state_(state), coupling_(coupling), horizon_(horizon) {}

// In liquid the same change of speed takes more impulse: the first bound makes up for it. The second one is on the
// energy of liquid and solids.
template <int Dim>
std::string ImpactsOfSolve<Dim>::act(InertiaProblem& problem, Eigen::VectorXd& push) {
  if (setup_.solids.restitutions.empty() || push.size() == 0) return {};
  const Eigen::SparseMatrix<double> none(push.size(), push.size());
  const InertiaResponse alone = problem.minimise(none, Eigen::VectorXd::Zero(push.size()));
  if (!alone.failure.empty()) return alone.failure;
  before_ = velocities_in(coupling_, state_);
  free_ = alone_ = alone.velocity;
  const DueRebounds due =
      due_rebounds(state_.impacts, ImpactColumns<Dim>(state_, coupling_, horizon_), before_, alone_);
  if (!due.any) return {};
  const InertiaResponse pushed = problem.minimise(none, due.push);
  if (!pushed.failure.empty()) return pushed.failure;
  const double curvature = due.push.dot(pushed.velocity - alone_);
  if (curvature <= 0) return {};
  const double share = std::min(due.response / curvature, share_within(due.slope, curvature, due.energy));
  work_ = share * (due.slope + 0.5 * share * curvature);
  push += share * due.push;
  free_ += share * (pushed.velocity - alone_);
  return {};
}

template <int Dim>
Impacts ImpactsOfSolve<Dim>::after(const Eigen::VectorXd& v, const std::vector<PairImpulse>& pairs, double dt) const {
  if (alone_.size() == 0) return {};
  Impacts impacts = ImpactSearch<Dim>(setup_, state_, coupling_, dt, horizon_, {before_, alone_, free_, v}).run(pairs);
  double work = work_;
  for (const Impact& earlier : state_.impacts) {
    if (earlier.stage != Impact::Stage::due) continue;
    Impact& impact = impacts.emplace_back();
    impact.first = earlier.first, impact.second = earlier.second;
    impact.stage = Impact::Stage::acted;
    impact.work = std::exchange(work, 0.0);
  }
  return impacts;
}

template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_rebounds() {
  return std::make_unique<Rebounds<Dim>>();
}

#define SEICHE_INSTANTIATE(D)       \
  template class ImpactsOfSolve<D>; \
  template std::unique_ptr<const Interaction<D>> make_rebounds<D>();
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
