#pragma once
// Patches of an elastic solid's surface between its pinned facets.
#include "solid/elastic/solid.h"

namespace seiche {

// Patches of each connected part in turn. If facets pinned by one motion divide the part, its patches are the pieces
// between them; else the whole part is one patch.
template <int Dim>
std::vector<SurfacePatch<Dim>> find_patches(const ElasticSurface& surface, const std::vector<PinnedNodes>& pins);

// Per mesh node: its patch; -1: the node is inside, or on pinned facets that belong to no patch.
template <int Dim>
std::vector<int> patches_of_nodes(const ElasticSolid<Dim>& solid);

}  // namespace seiche
