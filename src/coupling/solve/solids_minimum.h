#pragma once
// The velocities of rigid and elastic bodies that minimise their energy and the liquid's, contact and friction
// included.
#include "coupling/solve/liquid_problem.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

struct SolidsMinimum {
  Eigen::VectorXd velocity;
  Eigen::VectorXd reaction;  // N s: the impulse that holds each unknown, zero where it is free
  int newton_iterations = 0, contacts = 0;
  std::string failure;  // empty: found
};

// Where the liquid is inviscid: its solver, and the problem as what it is.
template <int Dim>
struct InviscidLiquid {
  const SpdSolver* solver = nullptr;
  LiquidProblem<Dim>* problem = nullptr;
};

// What belongs to the velocities in the liquid is left in the problem.
template <int Dim>
SolidsMinimum minimise_solids(const Setup<Dim>& setup, const State<Dim>& state, double dt, double horizon,
                              const SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                              const InviscidLiquid<Dim>& liquid);

}  // namespace seiche
