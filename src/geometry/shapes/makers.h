#pragma once
// The makers behind the shape table. Each builds one kind from its spec, in the shape's own frame unless noted. They
// throw Error(bad_input) without a location on impossible sizes. make_shape() adds location, transform and inversion.
#include <memory>
#include <string>

#include "geometry/shapes/shapes.h"

namespace seiche::shape {

template <int Dim>
using Field = std::unique_ptr<ShapeField<Dim>>;

template <int Dim>
Field<Dim> make_box(const ShapeSpec& spec, const ShapeOptions& options);
template <int Dim>
Field<Dim> make_sphere(const ShapeSpec& spec, const ShapeOptions& options);
template <int Dim>
Field<Dim> make_cylinder(const ShapeSpec& spec, const ShapeOptions& options);
template <int Dim>
Field<Dim> make_capsule(const ShapeSpec& spec, const ShapeOptions& options);
template <int Dim>
Field<Dim> make_plane(const ShapeSpec& spec, const ShapeOptions& options);
template <int Dim>
Field<Dim> make_expression(const ShapeSpec& spec, const ShapeOptions& options);
template <int Dim>
Field<Dim> make_level_set(const ShapeSpec& spec, const ShapeOptions& options);
// Below the heights of a map, without end: edges go on at their height. 3D: as a mesh, sampled.
template <int Dim>
Field<Dim> make_height_map(const ShapeSpec& spec, const ShapeOptions& options);

// In world coordinates: points are transformed first. 2D: exact, 3D: sampled.
template <int Dim>
Field<Dim> make_mesh(const ShapeSpec& spec, const ShapeOptions& options);

// The closed mesh of a "mesh" shape, or a polygon's outline, transformed. With invert its facets face the other way.
template <int Dim>
SurfaceMesh read_shape_mesh(const ShapeSpec& spec, const ShapeOptions& options);

void turn_inside_out(SurfaceMesh& mesh);

// The rotation matrix of a transform, exact for multiples of 90 degrees about a coordinate axis. 2D: about z. 3D:
// throws Error(bad_input) if the axis is zero.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> rotation(const RotationSpec& rotate);
template <>
Eigen::Matrix2d rotation<2>(const RotationSpec& rotate);
template <>
Eigen::Matrix3d rotation<3>(const RotationSpec& rotate);

// Throws Error(bad_input).
[[noreturn]] void refuse(const std::string& message);

}  // namespace seiche::shape
