#pragma once
// Filled outlines of 2D solids.
#include <vector>

#include "render/bvh.h"

namespace seiche::render {

using Vec2f = Eigen::Vector2f;
using Polygon = std::vector<Vec2f>;

// Joins the segments of one solid to closed polygons with the inside to their left. Chains that end at the border of
// the sampled region are closed along the border of `box`, enlarged to hold the whole mesh. A solid that is the outside
// of its outlines also gets that border.
std::vector<Polygon> close_outlines(const SolidMesh& solids, int solid, const Box& box);

// Coverage of each pixel (x0 <= x < x0 + n, row y) by the polygons with the even-odd rule; pixel coordinates.
std::vector<float> row_coverage(const std::vector<Polygon>& polygons, int x0, int n, int y);

}  // namespace seiche::render
