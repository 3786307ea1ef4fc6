#pragma once
// Projects the boundary nodes of a mesh onto the shape.
#include "geometry/shapes/shapes.h"
#include "solid/mesh/mesh.h"

namespace seiche {

// Moves boundary nodes, including mid-edge nodes of quadratic elements, to the nearest points of phi = 0, so that sides
// follow the shape. A node stays if it would move by more than a third of its shortest edge, or would leave an element
// less than a third of its Jacobian.
template <int Dim>
void fit_to_shape(ElasticMesh<Dim>& mesh, const ShapeField<Dim>& phi);

}  // namespace seiche
