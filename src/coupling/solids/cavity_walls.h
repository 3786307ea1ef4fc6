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
};

// Patches that touch the same liquid are walls of one cavity, if one of them is open or lies around the liquid. Walls
// that do not close, or that touch liquid with a given pressure, are left out. Cavities with open patches are also left
// out if they hold enclosed air, or if their volume is prescribed in part. An inflow does that, a pinned node of a
// closed wall, or a prescribed solid that does not move like the pins. Collective.
template <int Dim>
std::vector<FoundCavity<Dim>> find_cavities(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                            const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                                            const NullSpace& closed, const ElasticMotions& motions,
                                            const std::vector<BodyEntries>& bodies);

}  // namespace seiche
