#pragma once
// The level set tells where the liquid is, the volume of each cell how much there is. Both are brought together here:
// long waves of their difference move the level set, short ones the volumes
// (docs/decisions/0061-volumes-and-level-set.md).
#include "base/communicator.h"
#include "fluid/volume/ledger.h"
#include "grid/halo.h"

namespace seiche {

// Volumes moved by bringing both together, in cells, over all ranks.
struct Coupled {
  double level_set = 0;      // volume by which the level set was moved, sum of magnitudes
  double volumes = 0;        // volume handed on between cells
  std::int64_t rebuilt = 0;  // cells in which the level set is the distance from the pieces of the volumes
};

// phi (m) and the share of liquid of each cell, both at the same time with ghosts filled; psi (m): of the solids. The
// sum of the shares does not change. Fills the ghosts of both. Collective.
template <int Dim>
Coupled couple_level_set(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                         const NodeField<Dim>& psi, const Ledger<Dim>& ledger, CellField<Dim>& phi,
                         CellField<Dim>& share);

}  // namespace seiche
