#pragma once
// From the shape of an elastic solid to its elements.
#include "base/scene.h"
#include "geometry/shapes/shapes.h"
#include "solid/mesh/mesh.h"

namespace seiche {

// Elements of the solid's shape, edges about spec.elastic.element_size, or those of its file, in world coordinates, at
// spec.elastic.element_order. A box is cut into equal blocks; other shapes are meshed within their surface, and the
// nodes on curved ones lie on the shape itself. [lower, upper] is the domain, which cuts off what has no bounds of its
// own. The same scene gives the same mesh, also on another rank. The mesh has passed check_mesh().
// Throws Error(bad_input) naming spec.shape.where.
template <int Dim>
ElasticMesh<Dim> mesh_solid(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                            const Vec<Dim>& upper);

}  // namespace seiche
