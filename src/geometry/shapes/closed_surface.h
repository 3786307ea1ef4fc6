#pragma once
// Closed surfaces of shapes for contact.
#include "geometry/shapes/shapes.h"

namespace seiche {

// The closed, outward-oriented surface of a shape at rest; an inverted shape faces the other way. It does not intersect
// itself unless a mesh file does. Triangles in 3D, segments in 2D, in world coordinates.
//   box          8 points, 12 triangles (4 and 4 in 2D): exact, as is a cylinder in 2D
//   sphere,      inscribed: corners on the surface, chords at most 0.05 cells inside it, up to a number of points.
//   Limits cylinder,    (and the radius where they are reached): sphere 642 points (11 cells; 0.0046 radii inside
//   beyond), capsule      cylinder 128 around (42 cells), capsule 48 around (12 cells), 2D disc or capsule 256 (660
//   cells) plane        a block behind the plane that reaches beyond the domain, with two triangles as its face mesh
//   the file's own facets expression,  contoured at cell_size: up to h^2/(2 r) inside convex parts, sharp edges
//   rounded level_set    by up to a cell; cut off flat two cells beyond [lower, upper]
// Throws Error(bad_input) naming spec.where.
template <int Dim>
SurfaceMesh contact_surface(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                            const Vec<Dim>& upper);

}  // namespace seiche
