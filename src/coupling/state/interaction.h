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
  // Adds forces between participants to mass and push, once those of all participants exist.
  virtual void add_forces(const CoupledStep<Dim>&, CouplingParts<Dim>&) const {}
  // Corrects velocities for a step of dt (s) that is not the planned one, so that the constraints hold. `velocities`:
  // one vector per participant.
  virtual void keep_over(const State<Dim>&, double /*dt*/, std::vector<Eigen::VectorXd>& /*velocities*/) const {}
  // Stores results of a solve in the state, after Participant::take().
  virtual void take(const SolidCoupling<Dim>&, State<Dim>&) const {}
  // Moves participants to where constraints on their places hold at the solve at `time` (s). Empty, or what fails.
  virtual std::string settle(const Domain<Dim>&, State<Dim>&, double /*time*/) const { return {}; }
  // The same at the end of a step, for what is shown and measured.
  virtual void show(const Domain<Dim>&, State<Dim>&) const {}
  // Adds its energies to the statistics. Work (J) that it does on participants in the last step of dt (s).
  virtual void measure(const State<Dim>&, StepStats&) const {}
  virtual double driven_work(const State<Dim>&, double /*dt*/) const { return 0; }
  // Completes the initial state from a trial of the first step, before that step is repeated.
  virtual void inform(const State<Dim>& /*trial*/, State<Dim>& /*start*/) const {}
};

template <int Dim>
using Interactions = std::vector<std::unique_ptr<const Interaction<Dim>>>;

template <int Dim>
struct JointSet;
template <int Dim>
struct Force;

// All interactions possible in a scene. They keep references.
template <int Dim>
Interactions<Dim> make_interactions(const Domain<Dim>& domain, const std::vector<Body<Dim>>& bodies,
                                    const JointSet<Dim>& joints, const std::vector<Force<Dim>>& forces);

}  // namespace seiche
