#pragma once
// Cavities of liquid without a given pressure, and the patches of elastic bodies that are their walls.
#include "coupling/solids/cavity_volume.h"
#include "coupling/solids/link_graph.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Walls of a cavity, and the rows that their nodes displace liquid in.
template <int Dim>
struct FoundCavity {
  CavityWalls<Dim> walls;
  std::vector<std::set<Link>> links;  // one set a wall, found on this rank
  std::set<int> components;           // of the liquid in it, as NullSpace numbers them
  bool surrounds = false;             // liquid lies around all walls; none lies around the liquid
};

// Patches that touch the same liquid are walls of one cavity: some are open, or one lies around the liquid, or liquid
// lies around them all. Walls that do not close, or that touch liquid with a given pressure, are left out. Cavities
// that no wall lies around are also left out if they hold enclosed air, or if their volume is prescribed in part. An
// inflow does that, and a prescribed solid that does not move like the pins. So does a pinned node of a closed wall
// beside open ones. Bodies that liquid surrounds must be wet all over. Collective.
template <int Dim>
std::vector<FoundCavity<Dim>> find_cavities(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                            const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                                            const NullSpace& closed, const ElasticMotions& motions,
                                            const std::vector<BodyEntries>& bodies);

}  // namespace seiche
