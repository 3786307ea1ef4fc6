#pragma once
// Correction of the viscous stress across the surface of two viscous fluids.
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Adds to u* the viscous stress that edges lack where the surface crosses the link of two faces of one component.
// Velocity and shear stress are continuous there; the second derivative along the normal is not. Its jump is a+ - a- =
// [rho n/mu], with n the viscous acceleration on either side. Forces that drive the fluids apart cause it, such as the
// jump sigma dkappa/ds of the pressure's slope along the surface. For a surface at distance s from the middle of the
// link, the difference quotient is
//   mu (u_high - u_low)/h = stress + epsilon,   epsilon = (h/8) c mu (a+ - a-),   c = (1 - 2 |s|/h)^2 n_d^2,
// with n_d the component of the surface normal along the link. The error acts on the fluids as +-epsilon/h, which is
// missing in their n. So a+- = (rho n +- epsilon/h)/mu+-, solved for epsilon with n of the last step. Does nothing
// without viscosity or without Feature::shear_jump (both viscosities constant and positive). Collective.
template <int Dim>
void add_shear_jump(const Domain<Dim>& domain, const Fluids& fluids, const Features& features, const State<Dim>& state,
                    const CellField<Dim>& phi, double dt, FaceField<Dim>& u);

}  // namespace seiche
