#pragma once
// Faces beside solids, and flow continued beyond the fluid, for transport near solids and surfaces.
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Mean of psi over a face's corners, m, and its gradient there, m per cell.
template <int Dim>
struct FaceDistance {
  double psi = 0;
  Vec<Dim> gradient = Vec<Dim>::Zero();
};

template <int Dim>
FaceDistance<Dim> distance_at_face(const Layout<Dim>& layout, const NodeField<Dim>& psi, int axis, Site face);

// 1 on the owned faces within two cells of a solid that are `near` the fluid (1: fluid on at least one side). Velocity
// and acceleration continued into the solid are of second order there, so transport may read these faces whether liquid
// touches them or not. Two cells are more than a solid moves in a step. Solids thinner than a cell do not count:
// beyond them lies other liquid. Nor do deforming ones that move fast (docs/decisions/0049-flow-beside-solids.md).
template <int Dim>
FaceField<Dim, char> faces_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                         const StepGeometry<Dim>& geometry, const FaceField<Dim, char>& near);

// Extrapolates f from the valid faces into the others, linearly for two layers, constant beyond. Ghosts filled.
// Collective.
template <int Dim>
void continue_beyond(const Domain<Dim>& domain, const FaceField<Dim, char>& valid, FaceField<Dim>& f);

}  // namespace seiche
