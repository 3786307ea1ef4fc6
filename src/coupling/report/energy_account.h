#pragma once
// The account of energy: work done in a step, and the energy lost.
#include "coupling/state/attempt.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Power of the pressure on what flows through the sides of the domain, inwards: p u A, W (2D: W/m). u: the mean of
// `from` and `to`, velocities of all fluids. Outflow sides count beside liquid or flowing gas, with the pressure
// p_side - rho u_in u/2 (ProjectionInput::entry_factor). Collective.
template <int Dim>
double pressure_power_of_sides(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim>& from,
                               const FaceField<Dim>& to, const Attempt<Dim>& attempt);

// Work at the end of the attempt that started from `before`. `start`: measured of `before`; `solids`: of the attempt.
// Collective.
template <int Dim>
Work work_after(const Setup<Dim>& setup, const State<Dim>& before, const StepStats& start,
                const std::vector<SolidState>& solids, const Attempt<Dim>& attempt);

}  // namespace seiche
