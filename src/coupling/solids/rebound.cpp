#include "coupling/solids/rebound.h"

#include <algorithm>
#include <utility>

#include "coupling/solids/impact_search.h"
#include "coupling/state/dry.h"
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

// Rebounds that act together: impulses of all unknowns, what they do to the pairs.
struct DueRebounds {
  Eigen::VectorXd push;
  double slope = 0;     // their impulses times the mean speeds at which the pairs part without them, J
  double driven = 0;    // the part of it that is by prescribed motion, J
  double response = 0;  // sum of Impact::response
  double energy = 0;    // that they may give back, J
};

// `mean`: of the velocities before the solve and without these rebounds after it.
template <int Dim>
DueRebounds due_rebounds(const Impacts& impacts, const ImpactColumns<Dim>& columns, const Eigen::VectorXd& mean) {
  DueRebounds all;
  all.push.setZero(mean.size());
  for (const Impact& impact : impacts) {
    const ImpactColumn column = columns.column(impact.first, impact.second, impact.impulses);
    const double impulse = impact.share * column.size;
    column.add_to(all.push, impulse);
    all.slope += impulse * column.parting(mean);
    all.driven += impulse * column.prescribed;
    all.response += impact.response;
    all.energy += impact.energy;
  }
  return all;
}

// The rebounds that are due, in groups. Each group has a share of its own where solving for it costs little.
template <int Dim>
std::vector<Impacts> groups_of_due(const Setup<Dim>& setup, const Impacts& impacts, const ImpactColumns<Dim>& columns) {
  Impacts due;
  for (const Impact& impact : impacts)
    if (impact.stage == Impact::Stage::due && impact.share != 0) due.push_back(impact);
  if (due.empty()) return {};
  return is_dry(setup) ? clusters_of(due, columns) : std::vector<Impacts>{due};
}

}  // namespace

template <int Dim>
ImpactsOfSolve<Dim>::ImpactsOfSolve(const Setup<Dim>& setup, const State<Dim>& state,
                                    const SolidCoupling<Dim>& coupling, double horizon)
    : setup_(setup), state_(state), coupling_(coupling), horizon_(horizon) {}

template <int Dim>
std::string ImpactsOfSolve<Dim>::act(InertiaProblem& problem, Eigen::VectorXd& push) {
  if (setup_.solids.restitutions.empty() || push.size() == 0) return {};
  const Eigen::SparseMatrix<double> none(push.size(), push.size());
  const InertiaResponse alone = problem.minimise(none, Eigen::VectorXd::Zero(push.size()));
  if (!alone.failure.empty()) return alone.failure;
  before_ = velocities_in(coupling_, state_);
  free_ = alone_ = alone.velocity;
  Eigen::VectorXd given = Eigen::VectorXd::Zero(push.size());  // apart from `push`, which the problem reads
  const ImpactColumns<Dim> columns = columns_with(nullptr);    // no responses are asked for
  for (const Impacts& group : groups_of_due(setup_, state_.impacts, columns))
    if (std::string failure = act_together(group, columns, problem, given); !failure.empty()) return failure;
  push += given;
  return {};
}

// Beside liquid the same change of speed takes another impulse: the first bound makes up for it. The second
// one is on the energy of all. Work of groups one after the other: P_k (v_before + v_alone)/2 + sum_{j < k} P_k dv_j.
template <int Dim>
std::string ImpactsOfSolve<Dim>::act_together(const Impacts& group, const ImpactColumns<Dim>& columns,
                                              InertiaProblem& problem, Eigen::VectorXd& given) {
  const Eigen::VectorXd mean = 0.5 * (before_ - alone_) + free_;
  const DueRebounds due = due_rebounds(group, columns, mean);
  const InertiaResponse pushed = problem.minimise(Eigen::SparseMatrix<double>(given.size(), given.size()), due.push);
  if (!pushed.failure.empty()) return pushed.failure;
  const Eigen::VectorXd change = pushed.velocity - alone_;
  const double curvature = due.push.dot(change);
  if (curvature <= 0) return {};
  const double share = std::min(due.response / curvature, share_within(due.slope, curvature, due.energy));
  work_ += share * (due.slope - due.driven + 0.5 * share * curvature);
  given += share * due.push;
  free_ += share * change;
  return {};
}

template <int Dim>
Impacts ImpactsOfSolve<Dim>::after(const Eigen::VectorXd& v, const std::vector<PairImpulse>& pairs, double dt) const {
  if (alone_.size() == 0 || (pairs.empty() && state_.impacts.empty())) return {};
  ImpactColumns<Dim> columns = columns_with(jointed_inertia(coupling_, setup_.domain.ranks));
  const ImpactVelocities velocities{before_, alone_, free_, v};
  Impacts impacts = ImpactSearch<Dim>(setup_, state_, std::move(columns), dt, horizon_, velocities).run(pairs);
  const auto is_rebound = [](const Impact& i) { return i.stage != Impact::Stage::meeting; };
  const auto first = std::find_if(impacts.begin(), impacts.end(), is_rebound);
  if (first != impacts.end()) first->work = work_;
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
