#pragma once
// Drops that become liquid of the grid again.
#include "coupling/drops/flight.h"
#include "coupling/state/state.h"
#include "fluid/volume/ledger.h"

namespace seiche {

// A drop in the cell that took it up.
template <int Dim>
struct LandedDrop {
  Site cell;
  double share;       // of the cell
  Vec<Dim> place;     // m
  Vec<Dim> velocity;  // m/s
  std::int64_t id;
};

// Takes up drops that reach liquid, those on walls of more than half a cell, and others of more than a cell. Their
// volume goes to their cells and those beside them, by their room; what finds none is spilled. Fills ghosts of the
// shares. Collective.
template <int Dim>
std::vector<LandedDrop<Dim>> land_drops(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles,
                                        const Ledger<Dim>& ledger, State<Dim>& state);

// Gives the momentum of landed drops to the faces of their cells, or of the cell beside them that is deepest in the
// liquid, phi (m). With M the liquid beside a face without them, and m of them:
//   u* <- (M u* + sum m v)/(M + sum m).
// Momentum of axes whose faces are all closed is lost to the wall. Fills ghosts. Collective.
template <int Dim>
void give_momentum(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& phi,
                   const CellField<Dim>& share, const std::vector<LandedDrop<Dim>>& landed, FaceField<Dim>& u_star);

}  // namespace seiche
