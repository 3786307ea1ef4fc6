#pragma once
// The pieces of an elastic solid's surface that pinned facets leave.
#include "solid/elastic/solid.h"

namespace seiche {

// Those of each part of the surface in turn: the whole part, but where facets with all corners in pins of one motion
// divide it the pieces between these.
template <int Dim>
std::vector<SurfacePatch<Dim>> find_patches(const ElasticSurface& surface, const std::vector<PinnedNodes>& pins);

// Of each node of the mesh the patch that it is on, -1: it lies inside, or among pinned facets that are on none.
template <int Dim>
std::vector<int> patches_of_nodes(const ElasticSolid<Dim>& solid);

}  // namespace seiche
