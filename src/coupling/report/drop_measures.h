#pragma once
// Drops in the statistics, and as points for frames.
#include <optional>

#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Adds energies and momentum of drops, and sets their columns. Collective.
template <int Dim>
void measure_drops(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats);

// This rank's drops. In 2D z = 0. Empty if the scene makes none.
template <int Dim>
std::optional<std::vector<DropPoint>> drop_points(const Setup<Dim>& setup, const State<Dim>& state);

}  // namespace seiche
