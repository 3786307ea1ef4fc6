#pragma once
// The two ways in which viscosity enters the solve of a step.
#include "coupling/solve/solve_parts.h"

namespace seiche {

// Viscosity first, against the pressure of the last step:
//   F u + G v = M (u* - dt grad p/rho) + f,   G'u + (M + H_vv) v = push + dt A_f J'p + g.
// What it adds goes into r.u_star and the bodies' push; the solve of the pressure follows.
template <int Dim>
void act_before_pressure(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                         SolidCoupling<Dim>& coupling, CoupledSolution<Dim>& r);

// Pressure, viscosity and bodies at once.
template <int Dim>
void solve_with_viscosity(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                          const SolidCoupling<Dim>& coupling, CoupledSolution<Dim>& r);

}  // namespace seiche
