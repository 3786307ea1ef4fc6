#pragma once
// On which side of a line or plane a point lies, exactly: the sign of a determinant of coordinates as they are stored.
#include "base/vec.h"

namespace seiche {

// Sign of det(b - a, c - a) in the plane across `axis`: 1 if a, b, c turn counter-clockwise there, 0 on a line.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

// Sign of det(b - a, c - a, d - a): 1 if d lies on the side from which a, b, c turn counter-clockwise, 0 in their
// plane.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace seiche
