#pragma once
// phi within solids: whose liquid or air it stands for.
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "levelset/redistance.h"

namespace seiche {

// 1 in the cells that unmoved solids fill wholly: no face is open, no corner outside. Ghosts filled. Unmoved are static
// solids, and prescribed ones until they first move. In others phi goes along with the body: continued from air that
// stays behind it would bring out liquid that the body hides.
template <int Dim>
CellField<Dim, char> closed_cells(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                  const StepGeometry<Dim>& geometry);

// Continues phi straight into the closed cells, four layers deep. Fills ghosts. Collective.
template <int Dim>
void continue_level_set(const Domain<Dim>& domain, const Solids<Dim>& solids, const CellField<Dim, char>& closed,
                        CellField<Dim>& phi);

// The closed cells of solids through which phi bends: where phi and its straight continuation differ by a tenth of a
// cell near the zero in some cell of the solid. Elsewhere both are as good, and phi itself is no extrapolation, which
// narrow places between small solids amplify. Ghosts filled. Collective.
template <int Dim>
CellField<Dim, char> cells_to_continue(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                       const StepGeometry<Dim>& geometry, const CellField<Dim>& phi);

// Makes phi a distance outside the closed cells, as continued straight into them, and then within them beside what is
// outside. A surface redistanced through a wall bends towards the level on its other side, and sets liquid at rest
// beside it in motion. Transport reads the distance within, which a front takes along into the wall
// (docs/decisions/0029-level-set-in-static-solids.md). The iterations outside are shared among `passes`, each of which
// continues phi anew. Collective.
template <int Dim>
void redistance_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const CellField<Dim, char>& closed,
                              const RedistanceOptions& options, int passes, CellField<Dim>& phi);

// In elastic bodies phi is carried with the body's velocity next to its surface alone; farther in it stays behind when
// they move, and liquid of one side of a thick wall would come out at the other. From the depth of 1.5 cells on, for
// four layers, phi whose sign is not that of the nearest cells less deep (the mean of the neighbours a layer nearer to
// them) is set to what it is there. Cells less deep count as they are, also along sides and solids that the body
// touches. Elsewhere phi is left alone. Fills ghosts. Collective.
template <int Dim>
void keep_sides_of_walls(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

}  // namespace seiche
