#pragma once
// Velocities of rigid and elastic bodies that minimise their energy and the liquid's, with contact and friction.
#include "coupling/solve/liquid_problem.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

struct SolidsMinimum {
  Eigen::VectorXd velocity;
  Eigen::VectorXd reaction;  // N s: constraint impulse of each unknown, 0 if it is free
  int newton_iterations = 0, contacts = 0;
  bool friction_settled = true;
  std::vector<BodyImpulse> impulses;  // N s: of contact, one a solid; empty without contact
  std::vector<PairImpulse> pairs;     // ContactReport::pairs
  std::string failure;                // empty: found
};

// Inviscid liquid: its pressure solver and its problem. Null in viscous liquid.
template <int Dim>
struct InviscidLiquid {
  const SpdSolver* solver = nullptr;
  LiquidProblem<Dim>* problem = nullptr;
};

// Minimises over the velocities of the bodies. `problem` keeps the liquid's solution at the minimum. Newton's method
// goes on from `start`, velocities of an earlier solve over this horizon; empty: none. Collective.
template <int Dim>
SolidsMinimum minimise_solids(const Setup<Dim>& setup, const State<Dim>& state, double dt, double horizon,
                              const SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                              const InviscidLiquid<Dim>& liquid, const Eigen::VectorXd& start);

}  // namespace seiche
