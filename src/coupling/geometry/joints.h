#pragma once
// Where elastic solids are joined to others: pinned facets that stand on, or in, a solid that moves as their pins do.
#include "grid/fields.h"
#include "solid/rigid/state.h"

namespace seiche {

// A facet of an elastic solid's surface.
template <int Dim>
struct JoinedFacet {
  int body;
  std::array<int, Dim> points;
};

// Those within `clearance` (m) of a static solid, or of one that moves as prescribed.
template <int Dim>
std::vector<JoinedFacet<Dim>> find_joints(const std::vector<Body<Dim>>& bodies, double clearance);

// Not 0 at the low nodes of cells that such facets are in, and of those around. Empty where there are none.
template <int Dim>
NodeField<Dim, char> mark_joints(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 const std::vector<JoinedFacet<Dim>>& joints, const std::vector<Placement>& placed);

}  // namespace seiche
