#pragma once
// Where a segment goes through a facet of a surface.
#include <array>
#include <optional>

#include "base/vec.h"

namespace seiche {

// By this share segments and facets count as longer, so that what goes through an edge meets one of the facets there:
// far above rounding, far below what a grid sees.
constexpr double crossing_slack = 1e-9;

// The share of the way from p to q at which it meets a facet (2D: a segment, 3D: a triangle), empty where it does not.
// What runs within the facet's plane does not meet it.
template <int Dim>
std::optional<double> crossing(const Vec<Dim>& p, const Vec<Dim>& q, const std::array<Vec<Dim>, Dim>& facet);

}  // namespace seiche
