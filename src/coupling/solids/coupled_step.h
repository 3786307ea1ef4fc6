#pragma once
// What the solids and the liquid are coupled in: one solve of a step.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
struct CoupledStep {
  const Setup<Dim>& setup;
  const StepGeometry<Dim>& geometry;
  const PressureRows<Dim>& rows;
  const NullSpace& closed;
  const State<Dim>& state;
  double dt;       // that led there, s
  double horizon;  // over which velocities of solids are solved for, s
};

}  // namespace seiche
