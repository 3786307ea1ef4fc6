#pragma once
// Drops in the statistics, and as points for frames.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"

namespace seiche {

// Adds energies and momentum of drops, and sets their columns. Collective.
template <int Dim>
void measure_drops(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats);

// This rank's drops. In 2D z = 0.
template <int Dim>
std::vector<DropPoint> points_of(const Drops<Dim>& drops);

}  // namespace seiche
