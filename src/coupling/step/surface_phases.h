#pragma once
// Phases of a step around its solve that move surface and solids.
#include <optional>

#include "coupling/drops/landing.h"
#include "coupling/solids/end_of_step.h"
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/step/solid_phases.h"
#include "coupling/tension/surface_tension.h"
#include "fluid/volume/volume_transport.h"

namespace seiche {

// Surface and solids where the solve finds them; flow and pressure are still those of the step before.
template <int Dim>
struct Moved {
  State<Dim> state;
  StepGeometry<Dim> geometry;
  std::optional<SurfaceTension<Dim>> tension;
  std::optional<CellField<Dim>> brought{};              // share of each cell that sources brought before the solve
  CellValues fed{};                                     // what feeds bring into cells at the solve, m^Dim/s
  std::shared_ptr<const EndOfStep<Dim>> end = nullptr;  // of a leapfrog step in which solids move freely; else null
  std::optional<CellField<Dim, char>> closed{};         // closed_cells(); none in a look ahead
  std::vector<LandedDrop<Dim>> landed{};                // on this rank
  std::string failure{};                                // empty, or why the step cannot be taken
};

// Moves solids and surface, lets feeds act, measures the geometry between them, and keeps the volumes of liquid and
// enclosed air. Collective.
template <int Dim>
Moved<Dim> move_surface_and_solids(const Setup<Dim>& setup, const State<Dim>& before, const StepTimes& times,
                                   Phases& phases);

// The second half of a leapfrog step, by the velocities at its end; by those at its start where its end is too fast.
// `closed` as in Moved. Collective.
template <int Dim>
void move_second_half(const Setup<Dim>& setup, const State<Dim>& before, const StepTimes& times,
                      const CellField<Dim, char>& closed, Phases& phases, Attempt<Dim>& solved);

}  // namespace seiche
