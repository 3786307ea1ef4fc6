#pragma once
// Surface tension: the jump of the pressure over the surface, and how long a step it bears.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The jump on the faces whose cells' link the surface crosses, and how its curvatures were found.
template <int Dim>
struct SurfaceTension {
  FaceField<Dim> jump;                             // p_liquid - p_gas = sigma kappa, Pa; 0 elsewhere
  std::int64_t crossings = 0, by_differences = 0;  // over all ranks
};

// For phi (m) and solids as a step of dt is solved with, and phi `lead` seconds before (lead <= dt). Collective.
template <int Dim>
SurfaceTension<Dim> surface_tension(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                    const Tampering& tampering, const StepGeometry<Dim>& geometry,
                                    const CellField<Dim>& before, const CellField<Dim>& phi, double lead, double dt);

// Longest step for capillary waves, s: sqrt((rho + rho_gas) h^3/(4 pi sigma)) (Brackbill, Kothe, Zemach 1992);
// infinite without tension or where the scheme is semi-implicit. Surface and velocity leapfrog, stable for omega dt <
// 2: the shortest waves of the grid, omega^2 = 8 (3D; 2D 4) * 2.3 (1.8) sigma/(rho h^3) by the symbols of curvature and
// projection, have omega dt = 1.21 (0.75) there.
template <int Dim>
double capillary_step(const Domain<Dim>& domain, const Fluids& fluids);

}  // namespace seiche
