#pragma once
// Phases of a step that find its velocity: predict it, solve for pressure and solids, restore it from the pressure.
#include "coupling/solids/convected_pressure.h"
#include "coupling/step/surface_phases.h"
#include "coupling/transport/filling.h"
#include "coupling/transport/viscous_transport.h"

namespace seiche {

// The velocity before the solve, the pressure that moves with solids, and how the step treats viscosity.
template <int Dim>
struct Predicted {
  FaceField<Dim> u_star;  // m/s, ghosts filled
  ConvectedPressure<Dim> convected;
  ViscousPlan viscosity;
  double viscous_power = 0;             // Transported::viscous_power
  KnownLoads wall_loads;                // Transported::wall_loads
  std::vector<FaceImpulse> by_sources;  // Transported::by_sources
  CellValues fed;                       // Moved::fed
  Filling<Dim> filling;                 // cells that count as liquid in the solve
  std::string failure;                  // names a value that is not finite; empty: none
};

// u*, transported to the faces near liquid with the acceleration along its path. Collective.
template <int Dim>
Predicted<Dim> predict_velocity(const Setup<Dim>& setup, const State<Dim>& before, const Moved<Dim>& moved,
                                const StepTimes& times, Phases& phases);

// Pressure, solids and velocity at the end of the step, and the velocities of solids over the step to come. Collective.
template <int Dim>
Attempt<Dim> solve_and_plan(const Setup<Dim>& setup, const State<Dim>& before, Moved<Dim> moved,
                            const Predicted<Dim>& predicted, const StepTimes& times, Phases& phases);

// solve_and_plan() for volumes carried in cells. Cells of air that would be brought more than they hold count as liquid
// (Predicted::filling), and the step is solved again. Collective.
template <int Dim>
Attempt<Dim> solve_within_room(const Setup<Dim>& setup, const State<Dim>& before, Moved<Dim> moved,
                               Predicted<Dim> predicted, const StepTimes& times, Phases& phases);

// In place of both where the scene prescribes the flow. Collective.
template <int Dim>
Attempt<Dim> prescribe_velocity(const Domain<Dim>& domain, const Fluids& fluids, Moved<Dim> moved);

}  // namespace seiche
