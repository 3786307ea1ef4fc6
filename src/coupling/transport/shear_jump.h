#pragma once
// What differences across the surface of two viscous fluids miss of the stress.
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Adds to u* what the viscous stress at edges lacks where the surface crosses the link of two faces of one component.
// Velocity and shear stress are continuous there, the second derivative along the normal is not: by what drives the
// fluids apart, as the jump sigma dkappa/ds of the pressure's slope along the surface does, a+ - a- = [rho n/mu] with n
// the acceleration by viscosity on either side. For a surface s off the middle of the link the difference quotient is
//   mu (u_high - u_low)/h = stress + epsilon,   epsilon = (h/8) c mu (a+ - a-),   c = (1 - 2 |s|/h)^2 n_d^2
// n_d the normal's component along the link. The fluids feel +-epsilon/h of it: the n that they had lack just that, so
// that a+- = (rho n +- epsilon/h)/mu+-, which is solved for epsilon. The n are those of the last step. Left out where
// viscosity is no constant. Collective.
template <int Dim>
void add_shear_jump(const Domain<Dim>& domain, const Fluids& fluids, const Features& features, const State<Dim>& state,
                    const CellField<Dim>& phi, double dt, FaceField<Dim>& u);

}  // namespace seiche
