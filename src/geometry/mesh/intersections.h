#pragma once
// Self-intersections of surfaces of triangles.
#include <array>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// True if two triangles have a common point other than their shared corners or edge. Exact for the stored coordinates.
// Both must have an area.
bool intersect(const SurfaceMesh& mesh, const std::array<int, 3>& s, const std::array<int, 3>& t);

// True if the segments pq and ab have a common point, seen along an axis. Exact for the stored coordinates.
bool segments_meet_in_plane(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, int axis);

// Pairs of triangles that intersect, lower index first, in ascending order. Triangles without area are ignored, and
// their neighbours may touch along them.
std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh);

}  // namespace seiche::mesh
