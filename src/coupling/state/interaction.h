#pragma once
// Interactions between participants: constraints and potentials over the unknowns of several of them.
#include <memory>
#include <vector>

#include "coupling/state/participant.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
class Interaction {
 public:
  virtual ~Interaction() = default;
  // Corrects the columns of the participants, adds constraints and potentials. Called between Participant::take_sums()
  // and finish_columns(). Collective.
  virtual void couple(const CoupledStep<Dim>&, CouplingParts<Dim>&) const {}
  // Corrects velocities for a step of dt (s) that is not the planned one, so that the constraints hold. `velocities`:
  // one vector per participant.
  virtual void keep_over(const State<Dim>&, double /*dt*/, std::vector<Eigen::VectorXd>& /*velocities*/) const {}
  // Stores results of a solve in the state, after Participant::take().
  virtual void take(const SolidCoupling<Dim>&, State<Dim>&) const {}
  // Completes the initial state from a trial of the first step, before that step is repeated.
  virtual void inform(const State<Dim>& /*trial*/, State<Dim>& /*start*/) const {}
};

template <int Dim>
using Interactions = std::vector<std::unique_ptr<const Interaction<Dim>>>;

// All interactions possible in a scene. They keep a reference to `bodies`.
template <int Dim>
Interactions<Dim> make_interactions(const std::vector<Body<Dim>>& bodies);

}  // namespace seiche
