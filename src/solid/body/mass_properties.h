#pragma once
// Mass, centre and inertia of the shapes that rigid solids may have.
#include <Eigen/Core>

#include "base/vec.h"
#include "geometry/shapes/shapes.h"

namespace seiche {

struct MassProperties {
  double mass = 0;                                    // kg; in 2D kg/m
  double volume = 0;                                  // m^3; in 2D m^2
  Vec3 center{0, 0, 0};                               // of mass, at rest, the shape's transform applied, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, world axes at rest, kg m^2; 2D: only (2,2)
  Vec3 centroid = Vec3::Zero();                       // of the volume at rest, m: set where the scene gives the mass
};

// Exact for box, sphere, cylinder and capsule (scaled, rotated, translated) and for the polyhedron of a mesh. Shapes
// `expression` and `level_set` use their contact surface and must lie within [lower, upper]. Throws Error(bad_input)
// naming spec.where if the shape is unbounded (plane, inverted) or has no volume.
template <int Dim>
MassProperties mass_properties(const ShapeSpec& spec, double density, const ShapeOptions& options,
                               const Vec<Dim>& lower, const Vec<Dim>& upper);

// Mass properties of the volume within a closed surface: triangles in 3D, segments in 2D.
template <int Dim>
MassProperties mass_of_surface(const SurfaceMesh& surface, double density);

}  // namespace seiche
