#pragma once
// Surface tension: the pressure jump at the surface, and the time step limit.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Pressure jump on faces whose link the surface crosses, and how its curvatures were found.
template <int Dim>
struct SurfaceTension {
  FaceField<Dim> jump;                             // p_liquid - p_gas = sigma kappa, Pa; 0 elsewhere
  std::int64_t crossings = 0, by_differences = 0;  // all; those with CurvatureSource::differences; over all ranks
};

// Jump for a step of dt (s). `phi` (m) and `geometry` are those of the solve, `before` is phi `lead` seconds earlier
// (lead <= dt). Collective.
template <int Dim>
SurfaceTension<Dim> surface_tension(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                    const OperatorPerturbation& perturbation, const StepGeometry<Dim>& geometry,
                                    const CellField<Dim>& before, const CellField<Dim>& phi, double lead, double dt);

// Longest step for capillary waves, s: sqrt((rho + rho_gas) h^3/(4 pi sigma)) (Brackbill, Kothe, Zemach 1992). Infinite
// without tension and in the semi-implicit scheme. Surface and velocity form a leapfrog scheme, stable for omega dt <
// 2. The shortest waves of the grid have
//   omega^2 = 8 * 2.3 sigma/(rho h^3)   (2D: 4 * 1.8),
// by the symbols of curvature and projection, so omega dt = 1.21 (0.75) at this step.
template <int Dim>
double capillary_step(const Domain<Dim>& domain, const Fluids& fluids);

}  // namespace seiche
