#pragma once
// Primitive shapes as closed, outward-oriented surfaces in the shape's own frame, corners on the shape's surface.
#include "base/shape_spec.h"
#include "geometry/mesh/mesh.h"

namespace seiche {

// `chord` (m): largest distance of the surface inside the shape. The number of points is limited, so that it can be
// larger on large bodies.
template <int Dim>
SurfaceMesh tessellate_box(const ShapeSpec& spec, double chord);
template <int Dim>
SurfaceMesh tessellate_sphere(const ShapeSpec& spec, double chord);
template <>
SurfaceMesh tessellate_sphere<2>(const ShapeSpec& spec, double chord);
template <>
SurfaceMesh tessellate_sphere<3>(const ShapeSpec& spec, double chord);
template <int Dim>
SurfaceMesh tessellate_cylinder(const ShapeSpec& spec, double chord);
template <>
SurfaceMesh tessellate_cylinder<2>(const ShapeSpec& spec, double chord);
template <>
SurfaceMesh tessellate_cylinder<3>(const ShapeSpec& spec, double chord);
template <int Dim>
SurfaceMesh tessellate_capsule(const ShapeSpec& spec, double chord);
template <>
SurfaceMesh tessellate_capsule<2>(const ShapeSpec& spec, double chord);
template <>
SurfaceMesh tessellate_capsule<3>(const ShapeSpec& spec, double chord);

// The box spanned from `corner` by three edges that form a right-handed system. 2D: by the first two, z = 0.
template <int Dim>
SurfaceMesh block_surface(const Vec3& corner, const std::array<Vec3, 3>& edges);

}  // namespace seiche
