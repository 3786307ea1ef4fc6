#pragma once
// Meshes the shape of an elastic solid.
#include "base/solid_spec.h"
#include "geometry/shapes/shapes.h"
#include "solid/mesh/mesh.h"

namespace seiche {

// Elements of the solid's shape with edges of about spec.elastic.element_size, or those of its file, in world
// coordinates, of order spec.elastic.element_order. A box is cut into equal blocks. Other shapes are meshed within
// their surface, with the nodes of curved surfaces on the shape itself. [lower, upper] is the domain, which cuts off
// unbounded shapes. The same scene gives the same mesh on every rank. The mesh has passed check_mesh(). Throws
// Error(bad_input) naming spec.shape.where.
template <int Dim>
ElasticMesh<Dim> mesh_solid(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                            const Vec<Dim>& upper);

}  // namespace seiche
