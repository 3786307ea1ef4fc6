#pragma once
// Which patches of elastic bodies are the walls of liquid without a given pressure.
#include "coupling/solids/cavity_volume.h"
#include "coupling/solids/link_graph.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// A cavity's walls, and which rows their nodes push liquid in and out of.
template <int Dim>
struct FoundCavity {
  CavityWalls<Dim> walls;
  std::vector<std::set<Link>> links;  // of each wall, of this rank
  std::set<int> components;           // of the liquid in it, as NullSpace numbers them
};

// Patches join where they touch the same liquid. What is not closed, or touches a given pressure, is left out; so is,
// where there are pins, what a side with inflow or a solid feeds that moves as prescribed, but otherwise than these
// pins, and what holds enclosed air. Collective.
template <int Dim>
std::vector<FoundCavity<Dim>> find_cavities(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                            const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                                            const NullSpace& closed, const ElasticMotions& motions,
                                            const std::vector<BodyEntries>& bodies);

}  // namespace seiche
