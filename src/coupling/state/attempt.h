#pragma once
// A step as it is tried.
#include "base/timers.h"
#include "coupling/state/simulation.h"
#include "coupling/state/state.h"
#include "linalg/spd/solve.h"

namespace seiche {

// How a step went; `state` is only set where it succeeded.
template <int Dim>
struct Attempt {
  std::string failure;  // empty: accepted
  State<Dim> state;
  StepGeometry<Dim> geometry;
  StepStats stats;  // volumes, energies, momentum and speed at its end
  SolveReport solve;
  double divergence = 0;
  int newton_iterations = 0, contacts = 0;
  double dissipation = 0;       // by viscosity, W
  int rheology_iterations = 0;  // solves until viscosity and flow agreed
  double separation_error = 0;  // SeparationSearch::error
};

// The phases of a step, timed and open to fault injection.
struct Phases {
  Timers timers;
  FaultHook hook;
  std::vector<std::string> warnings;

  PhaseFault enter(const std::string& name) const { return hook ? hook(name) : PhaseFault::none; }
};

}  // namespace seiche
