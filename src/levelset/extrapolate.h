#pragma once
// Extrapolates a field from sites with known values to the others, layer by layer.
#include <functional>

#include "grid/halo.h"

namespace seiche {

struct ExtrapolateOptions {
  int layers = 4;
  int linear_layers = 0;                 // number of layers that are extrapolated linearly; the others are constant
  std::function<bool(Site)> bends = {};  // true for sites that get a parabola in the first layer; empty: none
};

// Extrapolates one component of a face field within `box`. known: 1 where data exist, 0 elsewhere; on return each
// reached site holds its layer + 1, counted from 1. Unreached sites keep their value. Sites beyond the sides of the
// domain are not filled. Collective.
template <int Dim>
void extrapolate(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box,
                 const ExtrapolateOptions& options, FieldValues<double>& f, FieldValues<char>& known);

// The same, but only linearly, for distances in metres. Values of magnitude `limit` and more do not count, since they
// may be clamped. A site needs two known sites in a line behind it; a slope from just two is limited to 1. Other sites
// wait for later layers and keep their value if none reaches them.
template <int Dim>
void extrapolate_straight(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box, int layers,
                          double limit, FieldValues<double>& f, FieldValues<char>& known);

}  // namespace seiche
