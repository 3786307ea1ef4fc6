#pragma once
// Filled outlines of 2D solids.
#include <vector>

#include "render/bvh.h"

namespace seiche::render {

// Joins the segments of one solid to closed polygons with the inside to their left. Chains that end at the border of
// the sampled region are closed along the border of `box`, enlarged to hold the whole mesh. A solid that is the outside
// of its outlines also gets that border.
std::vector<Polygon> close_outlines(const SolidMesh& solids, int solid, const Box& box);

// The outlines of all solids, one after another.
std::vector<std::vector<Polygon>> solid_outlines(const SolidMesh& solids, const Box& box);

// True if x is inside any of the solids, by the even-odd rule of each.
bool is_inside(const std::vector<std::vector<Polygon>>& solids, const Vec2f& x);

}  // namespace seiche::render
