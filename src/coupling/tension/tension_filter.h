#pragma once
// Curvature as steps longer than the shortest capillary waves bear it.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The semi-implicit curvature. At the end of a step curvature is kappa_e = kappa - dt Lap_s u_n, u_n the normal
// velocity that the jump sigma kappa_e itself makes (Hysing 2006; Sussman, Ohta 2009). For a wave of wavenumber k on
// deep liquid
//   (1 + beta (omega dt)^2) kappa_e = kappa,   omega^2 = sigma k^3/rho
// so that implicit curvature is curvature without its waves that are too short for the step. Here
//   (1 + (l Lap_s)^4) kappa_e = kappa,   read (l k)^4,   (1/l)^3 = s^2 rho/(sigma dt^2)
// which leaves resolved waves alone to (l k)^4, of order dt^(8/3), and holds omega dt below 1.5 for all k: the leapfrog
// of surface and velocity is stable below 2. Constant curvature passes unchanged: equilibria stay exact. Only the
// right side of the pressure knows of it.
//
// `kappa` (1/m) on faces whose link the surface crosses (`crossed`), l in cells; solved on the graph of the cells at
// both ends of these links, Lap_s its Laplacian, to 1e-10. Collective.
template <int Dim>
void filter_curvature(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim, char>& crossed,
                      double length, FaceField<Dim>& kappa);

// l in cells for steps of dt; 0 for steps that explicit tension bears.
double filter_length(double sigma, double density, double h, double dt);

}  // namespace seiche
