#pragma once
// Shear-dependent viscosity: Picard iteration between viscosity and flow within a step. Where viscosity rises with the
// shear rate as its power n - 1, an error of the flow returns as 1 - n of it, and would swing for ever from n = 2 on.
// Once the flow swings, the viscosity goes to the geometric mean of the old and the new one.
#include "coupling/solve/viscous_coupling.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
class RheologyIteration {
 public:
  // Starts with the viscosity for the velocities of `flow`. `state`: where surface and exterior stand in the solve.
  // Keeps references to setup and state.
  RheologyIteration(const Setup<Dim>& setup, const State<Dim>& state, const TimeLevel<Dim>& flow);
  const ViscosityField<Dim>& viscosity() const { return viscosity_; }
  int count() const { return count_; }  // number of solves; 0: Newtonian liquid
  // Largest change of velocity in the last solve, relative to the fastest; 0 if it is within the tolerance.
  double change_left() const;

  // Takes the velocities of the last solve. True if another solve is due, with the new viscosity(): they changed by
  // more than solver.rheology_tolerance of the fastest, and there were fewer than solver.rheology_iterations solves.
  // False for Newtonian liquid, and where friction did not settle and the change does not fall: forces of friction that
  // differ from solve to solve move the flow then. Collective.
  bool differs_from(const TimeLevel<Dim>& flow, bool friction_settled);

 private:
  const Setup<Dim>& setup_;
  const State<Dim>& state_;
  FaceField<Dim> last_, way_;  // velocities of the last solve, and their change in it, m/s
  ViscosityField<Dim> viscosity_;
  int count_ = 0;
  bool swings_ = false;
  double change_ = 0;  // relative, of the velocities
};

}  // namespace seiche
