#pragma once
// Whether surfaces intersect, by CGAL's exact predicates: independent of the distances that contact is solved with.
#include <vector>

#include "base/scene.h"
#include "geometry/mesh/mesh.h"

namespace seiche::exact {

enum class Mobility { free, prescribed, deformable };

struct PlacedSurface {
  SurfaceMesh mesh;
  Mobility mobility = Mobility::free;
};

// Pairs of triangles (2D: segments) with a common point, of two surfaces of which one at least is not prescribed, or of
// one deformable surface: there of elements that share no corner, or one side of an element and one that it has a
// single corner opposite to that side in common with.
int intersections(const std::vector<PlacedSurface>& surfaces);

// Points of surfaces that are not prescribed on or beyond a side of the domain.
int points_outside(const std::vector<PlacedSurface>& surfaces, const Scene& scene);

// For each surface that is not prescribed, in order, how often each other one winds round one of its points: 0 outside.
// Surfaces that do not intersect, but of which one has got into the other, show here.
std::vector<int> windings(const std::vector<PlacedSurface>& surfaces);

}  // namespace seiche::exact
