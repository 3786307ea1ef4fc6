#pragma once
// Enclosed air that keeps its volume: follows regions from step to step and corrects the surface around each.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Air regions of phi, with the volumes handed on from the regions in `before`. Merging regions add up. Parts of a
// region share its volume in proportion to their measured volumes. Regions that open are released. Regions that were
// open or are new take their measured volume. Each cell looks up its former region where its air was dt (s) ago; dt =
// 0: in place. Volumes of vanished regions are added to `lost` (m^Dim). Collective.
template <int Dim>
AirRegions<Dim> follow_air(const Domain<Dim>& domain, const AirRegions<Dim>& before, const FaceField<Dim>& u, double dt,
                           const StepGeometry<Dim>& geometry, const CellField<Dim>& phi, double& lost);

// Air regions of phi with their measured volumes. Collective.
template <int Dim>
AirRegions<Dim> initial_air(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, const CellField<Dim>& phi);

// Air volume of each region, m^Dim, and last that of all air that is not enclosed. Collective.
template <int Dim>
std::vector<double> air_volumes(const Domain<Dim>& domain, const AirRegions<Dim>& air, const NodeField<Dim>& psi,
                                const CellField<Dim>& phi);

// Volume of air near each region beyond its target, m^Dim: what the liquid leaves of the room in cells. `share`: of the
// liquid. Collective.
template <int Dim>
std::vector<double> excess_of_air(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry,
                                  const CellField<Dim>& phi, const CellField<Dim>& share, const Room<Dim>& room,
                                  const AirRegions<Dim>& air);

// Flux into each region that brings it to its target within in.excess_time, per face area, m/s. Without open air the
// regions share what the liquid takes or leaves in all, in proportion to their volumes: the fluxes of a closed box add
// up to zero. Collective.
template <int Dim>
std::vector<double> inflow_of_air(const ProjectionInput<Dim>& in, const AirRegions<Dim>& air);

// Shifts phi around each region so that it has its volume. Shifts phi at open surfaces so that the liquid has the
// expected volume (m^Dim). Shifts are at most `limit` (m). Without open air both cannot hold: the regions then share
// the space that the liquid leaves, in proportion to their volumes. Returns the liquid restored, m^Dim. Fills ghosts.
// Collective.
template <int Dim>
double control_volumes(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, double expected, double limit,
                       AirRegions<Dim>& air, CellField<Dim>& phi);

}  // namespace seiche
