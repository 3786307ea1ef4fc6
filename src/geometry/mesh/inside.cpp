#include "geometry/mesh/inside.h"

#include "geometry/mesh/exact_orientation.h"

namespace seiche::mesh {
namespace {

using Corners = std::array<Vec3, 3>;

// The side of the line through a and b on which p lies, seen along an axis. A point on the line is perturbed equally
// for all lines: by e^2 along the first and e along the second axis of the view, e -> 0 (simulation of simplicity;
// Edelsbrunner, Muecke 1990). No ray then meets an edge, and each line crosses a closed surface an even number of
// times.
int side_of(const Vec3& a, const Vec3& b, const Vec3& p, int axis) {
  if (const int side = orientation(a, b, p, axis); side != 0) return side;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  if (a[first] != b[first]) return a[first] < b[first] ? 1 : -1;
  if (a[second] != b[second]) return a[second] < b[second] ? -1 : 1;
  return 0;
}

// Orientation (1, -1) of a triangle that the line through p along the axis crosses, seen along the axis; 0 if the line
// misses it.
int crossing(const Corners& t, const Vec3& p, int axis) {
  const int side = side_of(t[0], t[1], p, axis);
  return side != 0 && side_of(t[1], t[2], p, axis) == side && side_of(t[2], t[0], p, axis) == side ? side : 0;
}

struct Crossings {
  int all = 0, beyond = 0;
};

Crossings count_crossings(const NearestTriangle& surface, const Vec3& x, int axis) {
  Crossings count;
  surface.visit_line(x, axis, [&](const Corners& t) {
    const int side = crossing(t, x, axis);
    if (side == 0) return;
    ++count.all;
    count.beyond += orientation(t[0], t[1], t[2], x) * side < 0;
  });
  return count;
}

}  // namespace

// An odd number of crossings on a whole line indicates a slit, left by dropped triangles without area. Another axis is
// tried then.
bool contains(const NearestTriangle& surface, const Vec3& x) {
  Crossings count;
  for (int axis = 0; axis < 3; ++axis) {
    count = count_crossings(surface, x, axis);
    if (count.all % 2 == 0) break;
  }
  return count.beyond % 2 == 1;
}

}  // namespace seiche::mesh
