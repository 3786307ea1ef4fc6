#pragma once
// Seams of elastic solids: pinned facets on or inside a solid that moves as their pins do.
#include "grid/fields.h"
#include "solid/rigid/state.h"

namespace seiche {

// A facet of the surface of elastic solid `body`. `points` are indices into ElasticSolid::surface.nodes.
template <int Dim>
struct SeamFacet {
  int body;
  std::array<int, Dim> points;
};

// Finds all seams at t = 0. A facet counts if each of its points is within `clearance` (m) of the other solid or
// inside it. The other solid must be static or prescribed, with the motion of the pins.
template <int Dim>
std::vector<SeamFacet<Dim>> find_seams(const std::vector<Body<Dim>>& bodies, double clearance);

// Nonzero at the low nodes of the cells that the bounding box of a facet of a seam touches, and of one layer of cells
// around. Empty field if there are no seams.
template <int Dim>
NodeField<Dim, char> mark_seams(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                const std::vector<SeamFacet<Dim>>& seams, const std::vector<Placement>& placed);

// Pairs of solids of which one may reach into the other, as jointed ones do. Each ascending.
using SharedPairs = std::vector<std::array<int, 2>>;

// Bounding box in space.
template <int Dim>
Eigen::AlignedBox<double, Dim> placed_box(const Body<Dim>& body, const Placement& placed);

// Nonzero at the low nodes of the cells where the bounding boxes of such a pair meet, and of one layer of cells around.
// Empty field if none meet.
template <int Dim>
NodeField<Dim, char> mark_shared(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 const SharedPairs& pairs, const std::vector<Placement>& placed);

}  // namespace seiche
