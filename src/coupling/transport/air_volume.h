#pragma once
// Enclosed air that keeps its volume: which region is which from step to step, and what the surface around each must
// make up for.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The regions that phi shows now, with the volumes they take over from those before: what merges adds up, what splits
// shares by the volumes measured, what opens is let go, what was open or new counts as measured. Cells look for their
// region where their air was dt ago, dt = 0: at the same place. Regions that are nowhere any more are added to `lost`.
// Collective.
template <int Dim>
AirRegions<Dim> follow_air(const Domain<Dim>& domain, const AirRegions<Dim>& before, const FaceField<Dim>& u, double dt,
                           const StepGeometry<Dim>& geometry, const CellField<Dim>& phi, double& lost);

// The regions of phi with the volumes that they have. Collective.
template <int Dim>
AirRegions<Dim> initial_air(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, const CellField<Dim>& phi);

// Air volume of each region, m^Dim, and last that of all air that is not enclosed. Collective.
template <int Dim>
std::vector<double> air_volumes(const Domain<Dim>& domain, const AirRegions<Dim>& air, const NodeField<Dim>& psi,
                                const CellField<Dim>& phi);

// Shifts phi around each region so that it has its volume, and at open surfaces so that the liquid has the expected
// one, by at most `limit` (m). Where no air is open both cannot be asked for: the regions share what the liquid leaves,
// in proportion. Returns the liquid restored, m^Dim. Collective.
template <int Dim>
double control_volumes(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, double expected, double limit,
                       AirRegions<Dim>& air, CellField<Dim>& phi);

}  // namespace seiche
