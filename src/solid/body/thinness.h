#pragma once
// Tests for solids thinner than a cell: such a solid may lie between grid nodes and let liquid through.
#include "solid/body/body.h"

namespace seiche {

// True if no ball of diameter h fits into the solid within the box [lower, upper]. Samples are h/4 apart, so
// thicknesses up to 1.3 h may count as thinner. Shapes that would need too many samples, shapes whose value is not a
// distance, and inverted shapes count as thick.
template <int Dim>
bool is_thinner_than(const Body<Dim>& body, double h, const Vec<Dim>& lower, const Vec<Dim>& upper);

// The same for an elastic solid at rest, sampled at nodes, edge middles and centroids of its elements.
template <int Dim>
bool is_thinner_than(const ElasticSolid<Dim>& solid, double h);

}  // namespace seiche
