#pragma once
// Drops made of liquid that the level set knows nothing of.
#include "coupling/drops/landing.h"
#include "coupling/state/fluids.h"

namespace seiche {

// A flow that carries the liquid's volumes: u (m/s, ghosts filled) and what falling adds to it until the drops set off.
template <int Dim>
struct CarryingFlow {
  const FaceField<Dim>& u;
  const FaceGeometry<Dim>& faces;
  const DropForces<Dim>& forces;
  double time, span;  // s: the middle of the fall, and how long it is
};

// Makes a drop of the liquid of each drifting cell (transport/drifting.h). It has the cell's volume, the mean velocity
// of its open faces, and begins in its middle. What landed in such a cell keeps its velocity, and is taken from
// `landed`. `keeps` false: leaves the drops out and takes them from what is expected. Fills ghosts of the shares.
// Collective.
template <int Dim>
void make_drops(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles, const CarryingFlow<Dim>& flow, bool keeps,
                std::vector<LandedDrop<Dim>>& landed, State<Dim>& state);

}  // namespace seiche
