#pragma once
// Outcome of an attempted step, and the hooks around its phases.
#include "base/timers.h"
#include "coupling/state/simulation.h"
#include "coupling/state/state.h"
#include "linalg/spd/solve.h"

namespace seiche {

// Powers in the solve of a step, W (2D: W/m).
struct SolvePowers {
  ViscousPower viscous;
  double viscous_transport = 0;  // of viscosity of fourth order, on the fluid (Transported::viscous_power)
  double tension = 0;            // of surface tension on both fluids
  double contact = 0;            // of prescribed solids on those that they touch
  double feeds = 0;              // of the pressure on what feeds bring, and kinetic energy of this
  double work_of_sources = 0;    // on what was where they set the velocity, J (2D: J/m)
};

// Outcome of an attempted step. `state` is valid only if `failure` is empty.
template <int Dim>
struct Attempt {
  std::string failure;       // empty: accepted
  bool contradicts = false;  // the failure is one of the scene, which shorter steps do not mend
  State<Dim> state;
  StepGeometry<Dim> geometry;
  StepStats stats;                 // volumes, energies, momentum and speed at its end
  std::vector<SolidState> solids;  // measured at its end
  SolveReport solve;
  double divergence = 0;  // largest |net flux|/volume of a cell, 1/s
  int newton_iterations = 0, contacts = 0;
  int joint_turns = 0;
  bool friction_settled = true;  // ContactReport::friction, of the last solve
  SolvePowers powers;
  int rheology_iterations = 0;  // solves until viscosity and flow agree
  double rheology_change = 0;   // of velocity in the last of them, relative to the largest; 0: they agree
  double separation_error = 0;  // SeparationSearch::error
};

// Timers, fault injection and warnings of a step's phases.
struct Phases {
  Timers timers;
  FaultHook hook;
  std::vector<std::string> warnings;

  PhaseFault enter(const std::string& name) const { return hook ? hook(name) : PhaseFault::none; }
};

}  // namespace seiche
