#pragma once
// Continues a field from the sites where it is known into those where it is not, layer by layer.
#include "grid/halo.h"

namespace seiche {

struct ExtrapolateOptions {
  int layers = 4;
  int linear_layers = 0;  // the first layers continue straight lines, the others the nearest value
};

// One component of a face field. known: 1 where data exist, 0 elsewhere; on return each reached site holds its layer
// + 1. Sites never reached keep their value. Domain-boundary sites beyond the sides are not filled. Collective.
template <int Dim>
void extrapolate(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box,
                 const ExtrapolateOptions& options, std::vector<double>& f, std::vector<char>& known);

// The same along straight lines alone, for distances in metres. Values of magnitude `limit` and more do not count: they
// may be cut off. Sites with no two known ones in a line behind them are left to later layers, and in the end as they
// are.
template <int Dim>
void extrapolate_straight(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box, int layers,
                          double limit, std::vector<double>& f, std::vector<char>& known);

}  // namespace seiche
