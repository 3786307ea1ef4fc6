#pragma once
// The domain on this rank: its grid, its sides, and the exchange with other ranks.
#include "base/communicator.h"
#include "fluid/boundary/domain_boundary.h"
#include "grid/halo.h"
#include "grid/partition.h"

namespace seiche {

// Keeps references to itself, so it can be neither copied nor moved.
template <int Dim>
struct Domain {
  Communicator ranks;
  std::vector<Box<Dim>> blocks;  // owned cells of each rank
  Layout<Dim> layout;
  Halo<Dim> halo;
  DomainBoundary<Dim> sides;

  // `reach`: largest number of cells that a step carries values across. `blocks` empty: of equal size. `gravity`
  // (m/s^2) is for waves at sides.
  Domain(const DomainSpec& spec, WallFlow flow, int reach, const Communicator& ranks, std::vector<Box<Dim>> blocks = {},
         const Vec3& gravity = Vec3::Zero());
  Domain(const Domain&) = delete;

  // Half width of the level-set band, m: the cells that a step can cross plus the reach of the stencils.
  double band() const { return (layout.halo() + 1) * layout.h(); }
  // Layers of velocity extrapolation beyond the liquid.
  int extrapolated_layers() const { return layout.halo(); }
};

}  // namespace seiche
