#pragma once
// The domain on this rank: its grid, its sides, and the exchange with other ranks.
#include "base/communicator.h"
#include "fluid/boundary/domain_boundary.h"
#include "grid/halo.h"

namespace seiche {

// Keeps references to itself: neither copied nor moved.
template <int Dim>
struct Domain {
  Communicator ranks;
  Layout<Dim> layout;
  Halo<Dim> halo;
  DomainBoundary<Dim> sides;

  // A step carries values across at most `reach` cells.
  Domain(const DomainSpec& spec, WallFlow flow, int reach, const Communicator& ranks);
  Domain(const Domain&) = delete;

  // Half width of the level-set band, m: the cells that a step can cross, and the reach of the stencils.
  double band() const { return (layout.halo() + 1) * layout.h(); }
  // Layers by which the velocity is continued beyond the liquid.
  int extrapolated_layers() const { return layout.halo(); }
};

}  // namespace seiche
