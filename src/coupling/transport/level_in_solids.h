#pragma once
// phi within solids: the liquid or air that it stands for.
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "levelset/redistance.h"

namespace seiche {

// 1 in the cells that unmoved solids fill entirely: no face is open, no corner outside. Ghosts filled. Unmoved solids
// are static ones, and prescribed ones and those that joints hold still until they first move. In other solids phi
// moves with the body. There, extrapolation from air behind a moving body would release liquid that the body hides.
// Collective.
template <int Dim>
CellField<Dim, char> closed_cells(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                  const StepGeometry<Dim>& geometry);

// Extrapolates phi along straight lines into the closed cells, four layers deep. Fills ghosts. Collective.
template <int Dim>
void continue_level_set(const Domain<Dim>& domain, const Solids<Dim>& solids, const CellField<Dim, char>& closed,
                        CellField<Dim>& phi);

// The closed cells of the solids in which phi is bent: in some cell near the zero it differs from its straight
// extrapolation by more than a fiftieth of a cell. The bound is the way of the fastest liquid near the surface in
// dt (s), by u (m/s), where that is longer, up to a tenth of a cell. In other solids both are equally good and phi is
// kept, since narrow gaps between small solids amplify extrapolation. Ghosts filled. Collective.
template <int Dim>
CellField<Dim, char> cells_to_continue(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                       const StepGeometry<Dim>& geometry, CellField<Dim, char> closed,
                                       const CellField<Dim>& phi, const FaceField<Dim>& u, double dt);

// Makes phi a distance outside the closed cells, with its straight extrapolation inside them. Then makes it a distance
// inside them, with the outside fixed. Closed cells that stand for a wall's other side are not read from this one.
// A surface redistanced through a wall bends towards the level on its other side,
// which sets liquid at rest beside it in motion. Transport also reads the distance inside, which a front carries along
// into the wall (docs/decisions/0029-level-set-in-static-solids.md). The iterations outside are divided among `passes`,
// each of which extrapolates phi anew. Collective.
template <int Dim>
void redistance_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const CellField<Dim, char>& closed,
                              const RedistanceOptions& options, int passes, CellField<Dim>& phi);

// Transports phi anew from `before` in open cells near closed ones where the velocity u (m/s) moves it by less than a
// tenth of a cell in dt (s). There the surface follows what the solve lets through narrow faces
// (let_surface_through_gaps()), and phi in closed cells is not read: it bends towards the level on the wall's other
// side. Otherwise waves at a waterline would grow. Faster fronts run on into the wall. Collective.
template <int Dim>
void carry_slow_near_closed(const Domain<Dim>& domain, const CellField<Dim, char>& closed, const State<Dim>& state,
                            FaceField<Dim> u, double dt, const CellField<Dim>& before, CellField<Dim>& phi);

// Slow flow through narrow faces near closed cells starts from its own velocity (keep_inertia_in_gaps()), within two
// cells of the surface and where transport does not read the face. From the velocity extrapolated from beside, the
// solve would gain energy in each step, and waves would grow along a wall's waterline
// (docs/decisions/0029-level-set-in-static-solids.md). u in m/s, after the body force g (m/s^2). Not beside gas.
template <int Dim>
void keep_inertia_near_closed(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces,
                              const CellField<Dim, char>& closed, const State<Dim>& state, const CellField<Dim>& phi,
                              const Vec3& gravity, double dt, FaceField<Dim>& u);

// Keeps phi on the two sides of thick elastic walls apart. In elastic bodies phi moves with the body only near its
// surface. Deeper inside it stays behind, and liquid from one side would emerge at the other. Four layers from a depth
// of 1.5 cells on are checked against the nearest cells less deep: phi with another sign takes their value, the mean of
// the neighbours one layer nearer to them. Cells less deep count as they are, also along sides and solids that the body
// touches. Other cells keep phi. Fills ghosts. Collective.
template <int Dim>
void keep_sides_of_walls(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

}  // namespace seiche
