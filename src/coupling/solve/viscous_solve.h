#pragma once
// Viscosity in the solve of a step: split or coupled.
#include "coupling/solve/solve_parts.h"

namespace seiche {

// Split: viscosity first, with the pressure of the last step:
//   F u + G v = M (u* - dt grad p/rho) + f,   G'u + (M + H_vv) v = push + dt A_f J'p + g.
// Adds its effect to r.u_star and coupling.push; the solve for pressure follows.
template <int Dim>
void act_before_pressure(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                         SolidCoupling<Dim>& coupling, CoupledSolution<Dim>& r);

// Coupled: pressure, viscosity and bodies in one solve.
template <int Dim>
void solve_with_viscosity(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                          const SolidCoupling<Dim>& coupling, CoupledSolution<Dim>& r);

}  // namespace seiche
