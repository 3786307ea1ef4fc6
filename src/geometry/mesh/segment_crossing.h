#pragma once
// Intersection of a segment with a facet of a surface.
#include <array>
#include <optional>

#include "base/vec.h"

namespace seiche {

// Relative extension of segments and facets, so that a segment through an edge meets one of its facets. Far above
// round-off, far below grid resolution.
constexpr double crossing_slack = 1e-9;

// Fraction of the way from p to q at which it meets a facet (2D: a segment, 3D: a triangle); empty if it does not.
// Segments within the facet's plane do not meet it.
template <int Dim>
std::optional<double> crossing(const Vec<Dim>& p, const Vec<Dim>& q, const std::array<Vec<Dim>, Dim>& facet);

}  // namespace seiche
