#pragma once
// Whether a grid can see a solid: one that is thinner than a cell may lie between the nodes and let liquid through.
#include "solid/body/body.h"

namespace seiche {

// Whether no ball of diameter h fits into the solid within the box [lower, upper], by samples a quarter of h apart: up
// to 1.3 h may count as thinner. Shapes that are too large for that many samples, those whose value is no distance,
// and the outsides of shapes (invert) count as thick.
template <int Dim>
bool is_thinner_than(const Body<Dim>& body, double h, const Vec<Dim>& lower, const Vec<Dim>& upper);

// The same of an elastic solid at rest, by the nodes, the middles of the edges and the centroids of its elements.
template <int Dim>
bool is_thinner_than(const ElasticSolid<Dim>& solid, double h);

}  // namespace seiche
