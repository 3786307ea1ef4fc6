#pragma once
// Streamlines of a 2D velocity, evenly spaced.
#include <functional>

#include "render/fields.h"

namespace seiche::render {

// Lines that keep about `spacing` m from each other and run through the points where `flows` holds: B. Jobard,
// W. Lefer, Creating evenly-spaced streamlines of arbitrary density, Visualization in Scientific Computing (1997). Each
// has at least three points, in the direction of the flow. Resting fluid has none.
std::vector<Polygon> streamlines(const FaceVelocity& velocity, float spacing,
                                 const std::function<bool(const Vec2f&)>& flows);

}  // namespace seiche::render
