#pragma once
// Forces of the scene on the liquid.
#include "coupling/state/attempt.h"
#include "coupling/state/force.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Adds to u (m/s, ghosts filled again) what sponges and forces do over a step of dt that ends at t. Fields: dt a in the
// middle of the step. Drag: u approaches w + dt g by exp(-rate dt). Wind: the stress C rho |w - u| (w - u) along the
// surface, rho that of air, accelerates the topmost layer of liquid, down to the bottom of its cells. Throws
// Error(cannot_continue) if a formula is not finite or a rate is negative. Collective.
template <int Dim>
void act_on_liquid(const Setup<Dim>& setup, const CellField<Dim>& phi, double t, double dt, FaceField<Dim>& u);

// Work of forces and sponges on the liquid over the step (J; 2D: J/m), with the mean of the velocities before and after
// it and the volume of liquid at its end. Collective.
template <int Dim>
double work_of_forces(const Setup<Dim>& setup, const State<Dim>& before, const Attempt<Dim>& attempt);

// Bound of the velocities (m/s) that drags can give within dt after t, of 17^Dim points of the domain.
template <int Dim>
double fastest_dragged(const Domain<Dim>& domain, const std::vector<Force<Dim>>& forces, double t, double dt);

}  // namespace seiche
