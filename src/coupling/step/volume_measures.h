#pragma once
// Volumes of liquid in the statistics where cells have them from the last solve.
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// measure_tracked() at the state's time: with what sides and feeds brought since the last solve. Collective.
template <int Dim>
void measure_volumes(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const State<Dim>& state,
                     StepStats& stats);

// Line for the log: how the liquid's volume is kept, and why.
template <int Dim>
std::string describe_volume(const Setup<Dim>& setup);

}  // namespace seiche
