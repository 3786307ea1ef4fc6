#pragma once
// Joints of elastic solids: pinned facets on or inside a solid that moves as their pins do.
#include "grid/fields.h"
#include "solid/rigid/state.h"

namespace seiche {

// A facet of the surface of elastic solid `body`. `points` are indices into ElasticSolid::surface.nodes.
template <int Dim>
struct JoinedFacet {
  int body;
  std::array<int, Dim> points;
};

// Finds all joints at t = 0. A facet counts if each of its points is within `clearance` (m) of the other solid or
// inside it. The other solid must be static or prescribed, with the motion of the pins.
template <int Dim>
std::vector<JoinedFacet<Dim>> find_joints(const std::vector<Body<Dim>>& bodies, double clearance);

// Nonzero at the low nodes of the cells that the bounding box of a joined facet touches, and of one layer of cells
// around. Empty field if there are no joints.
template <int Dim>
NodeField<Dim, char> mark_joints(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 const std::vector<JoinedFacet<Dim>>& joints, const std::vector<Placement>& placed);

}  // namespace seiche
