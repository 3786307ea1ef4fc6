#pragma once
// What acts between participants: constraints and potentials over the unknowns of several of them.
#include <memory>
#include <vector>

#include "coupling/state/participant.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
class Interaction {
 public:
  virtual ~Interaction() = default;
  // After the participants: corrects their columns, adds constraints and potentials. Collective.
  virtual void couple(const CoupledStep<Dim>&, CouplingParts<Dim>&) const {}
  // Keeps to the constraints over a step of dt that is not the one planned. `velocities`: of each participant.
  virtual void keep_over(const State<Dim>&, double /*dt*/, std::vector<Eigen::VectorXd>& /*velocities*/) const {}
  // After a solve.
  virtual void take(const SolidCoupling<Dim>&, State<Dim>&) const {}
  // The start of the run, taken again after a trial of the first step.
  virtual void inform(const State<Dim>& /*trial*/, State<Dim>& /*start*/) const {}
};

template <int Dim>
using Interactions = std::vector<std::unique_ptr<const Interaction<Dim>>>;

// All that may act in this scene.
template <int Dim>
Interactions<Dim> make_interactions(const std::vector<Body<Dim>>& bodies);

}  // namespace seiche
