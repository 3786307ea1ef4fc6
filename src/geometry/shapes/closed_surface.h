#pragma once
// Closed surfaces that contacts see.
#include "geometry/shapes/shapes.h"

namespace seiche {

// The surface of the shape at rest: closed, outward-oriented, without self-intersections as far as a mesh file has
// none; inverted it faces the other way. Triangles in 3D, segments in 2D, in world coordinates.
//   box          8 points, 12 triangles (4 and 4 in 2D): exact, as is a cylinder in 2D
//   sphere,      inscribed: corners on the surface, chords at most 0.05 cells inside it as long as the bound on points
//   cylinder,    allows: 642 points a sphere (so up to a radius of 11 cells; beyond 0.0046 radii), 128 round a cylinder
//   capsule      (42 cells), 48 round a capsule (12 cells); in 2D 256 round a disc or capsule (660 cells)
//   plane        a block beyond the domain with one pair of triangles as its face
//   mesh         the file's own triangles
//   expression,  contoured at cell_size: up to h^2/(2 r) inside convex parts, sharp edges rounded
//   level_set    by up to a cell; cut off flat two cells beyond [lower, upper]
// Throws Error(bad_input) naming spec.where.
template <int Dim>
SurfaceMesh contact_surface(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                            const Vec<Dim>& upper);

}  // namespace seiche
