#pragma once
// Viscosity that depends on the shear rate: solved for by turns with the flow (Picard), within a step.
#include "coupling/solve/viscous_coupling.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
class RheologyIteration {
 public:
  // Begins with the viscosity of the velocities of `flow`. Keeps a reference to the setup.
  RheologyIteration(const Setup<Dim>& setup, const CellField<Dim>& phi, const TimeLevel<Dim>& flow, double t);
  const ViscosityField<Dim>& viscosity() const { return viscosity_; }
  int count() const { return count_; }  // of solves; 0 in Newtonian liquid
  double change() const { return change_; }

  // Takes the velocities that the last solve gave. Whether another solve is due: they differ from those before by more
  // than solver.rheology_tolerance of the fastest, and solver.rheology_iterations are not used up. Never in Newtonian
  // liquid. Collective.
  bool differs_from(const TimeLevel<Dim>& flow);

 private:
  const Setup<Dim>& setup_;
  CellField<Dim> phi_;
  double time_;
  FaceField<Dim> last_;
  ViscosityField<Dim> viscosity_;
  int count_ = 0;
  double change_ = 0;  // relative, of the velocities
};

}  // namespace seiche
