#pragma once
// Nodes on the boundary of a mesh brought onto the shape that it stands for.
#include "geometry/shapes/shapes.h"
#include "solid/mesh/mesh.h"

namespace seiche {

// Moves the boundary's nodes to the nearest points of phi = 0, those between corners of quadratic elements too: their
// sides then follow the shape. A node that would have to go further than a third of its shortest edge, or would leave
// an element with less than a third of its Jacobian, stays where it is.
template <int Dim>
void fit_to_shape(ElasticMesh<Dim>& mesh, const ShapeField<Dim>& phi);

}  // namespace seiche
