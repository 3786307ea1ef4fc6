#pragma once
// Semi-implicit surface tension: filters curvature in steps too long for the shortest capillary waves.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The curvature at the end of a step is kappa_e = kappa - dt Lap_s u_n. The normal velocity u_n is the one that the
// jump sigma kappa_e itself causes (Hysing 2006; Sussman, Ohta 2009). For a wave of wavenumber k on deep liquid this
// gives
//   (1 + beta (omega dt)^2) kappa_e = kappa,   omega^2 = sigma k^3/rho,
// with a constant beta. The result has no waves too short for the step. This filter solves
//   (1 + l^4 Lap_s^2) kappa_e = kappa,   l^3 = sigma dt^2/(1.4 rho),
// with the factor 1 + (l k)^4 for a wave. It changes resolved waves by (l k)^4 = O(dt^(8/3)). It keeps omega dt below
// 1.5 for all k, and the leapfrog of surface and velocity is stable below 2. Constant curvature passes unchanged, so
// equilibria stay exact. Only the right-hand side of the pressure system changes.
//
// `kappa` (1/m) is given on faces whose link the surface crosses (`crossed`), halos filled; `length` is l in cells.
// Lap_s is the Laplacian of SurfaceGraph. Solved to a relative residual of 1e-10. Collective.
template <int Dim>
void filter_curvature(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim, char>& crossed,
                      double length, FaceField<Dim>& kappa);

// l in cells for steps of dt; 0 for steps within the explicit limit.
double filter_length(double sigma, double density, double h, double dt);

}  // namespace seiche
