#pragma once
// Inputs of the coupling of solids and liquid in one solve.
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
  double dt;       // step that led to `state`, s
  double horizon;  // interval over which velocities of solids are solved for, s
};

}  // namespace seiche
