#pragma once
// Solids that take on the meshes of a sequence: a surface whose points all have prescribed motion.
#include "solid/elastic/solid.h"

namespace seiche {

// Reads the meshes of spec.sequence. The solid has the points of the first mesh as nodes, no elements, and a mass that
// only keeps its rows of the coupled system regular. Throws Error(bad_input) naming spec.shape.where: a file is
// missing, open or crosses itself, its facets are others than those of the first, or points cross between two meshes.
template <int Dim>
ElasticSolid<Dim> make_deforming_solid(const SolidSpec& spec, const ShapeOptions& options);

}  // namespace seiche
