#pragma once
// Intersection tests of surfaces by CGAL's exact predicates: independent of the distances used by the contact solver.
#include <vector>

#include "base/scene.h"
#include "geometry/mesh/mesh.h"

namespace seiche::exact {

enum class Mobility { free, prescribed, deformable };

struct PlacedSurface {
  SurfaceMesh mesh;
  Mobility mobility = Mobility::free;
};

// Number of pairs of triangles (2D: segments) with a common point. Counts pairs of two surfaces, not both prescribed.
// Within one deformable surface it counts elements without a common corner, and a side of one element with another
// element that shares only the corner opposite to that side.
int intersections(const std::vector<PlacedSurface>& surfaces);

// Number of points on or beyond a closed side of the domain, of surfaces that are not prescribed.
int points_outside(const std::vector<PlacedSurface>& surfaces, const Scene& scene);

// Winding numbers of the other surfaces about one point of each surface that is not prescribed, in order; 0 is outside.
// Detects a surface inside another one without intersection.
std::vector<int> windings(const std::vector<PlacedSurface>& surfaces);

}  // namespace seiche::exact
