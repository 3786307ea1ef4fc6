#pragma once
// Restitution of rigid solids by Poisson's hypothesis. Contact brings solids that meet to rest against each other; in
// the next solve impulses at the same places make them rebound. docs/contact.md#restitution has the equations.
#include "coupling/solids/impact_columns.h"
#include "coupling/state/interaction.h"
#include "coupling/state/setup.h"

namespace seiche {

// Impacts before and after one solve, whose velocities hold over the horizon (s).
template <int Dim>
class ImpactsOfSolve {
 public:
  ImpactsOfSolve(const Setup<Dim>& setup, const State<Dim>& state, const SolidCoupling<Dim>& coupling, double horizon);
  // Adds the rebounds that are due to `push`, the coupling's, as far as the energy goes that their impacts took. Empty,
  // or what fails. Collective.
  std::string act(InertiaProblem& problem, Eigen::VectorXd& push);
  // Impacts under way after the solve over dt (s) found velocities v and impulses of contact between pairs. Collective.
  Impacts after(const Eigen::VectorXd& v, const std::vector<PairImpulse>& pairs, double dt) const;

 private:
  std::string act_together(const Impacts& group, const ImpactColumns<Dim>& columns, InertiaProblem& problem,
                           Eigen::VectorXd& given);
  ImpactColumns<Dim> columns_with(std::shared_ptr<const BodyMatrix> jointed) const {
    return {state_, coupling_, std::move(jointed), horizon_};
  }

  const Setup<Dim>& setup_;
  const State<Dim>& state_;
  const SolidCoupling<Dim>& coupling_;
  double horizon_;
  // Velocities before the solve; without contact and rebounds; without contact.
  Eigen::VectorXd before_, alone_, free_;
  double work_ = 0;  // of the rebounds, J
};

// Books the work of rebounds.
template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_rebounds();

}  // namespace seiche
