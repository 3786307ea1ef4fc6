#pragma once
// The side of a line or plane on which a point lies, exactly: the sign of a determinant of the stored coordinates.
#include "base/vec.h"

namespace seiche {

// Sign of det(b - a, c - a) in the plane perpendicular to `axis`: 1 if a, b, c turn counter-clockwise, 0 on a line.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

// Sign of det(b - a, c - a, d - a): 1 if d lies on the side from which a, b, c appear counter-clockwise, 0 in their
// plane.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace seiche
