#pragma once
// Closed polylines: the surfaces of 2D shapes.
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/mesh/distance.h"
#include "geometry/mesh/mesh.h"

namespace seiche {

// Reads closed polylines: a point a row, with an empty line between two of them (CSV, TXT), or the lines of an OBJ file
// at z = 0. Welds equal points and drops lines without length with a note. Polylines within others bound holes; the
// inside then lies to the left of all. Checks that they are closed and do not cross or touch. Throws Error(bad_input)
// naming the file and the line, or the number and place of the defects.
SurfaceMesh read_closed_polylines(const std::filesystem::path& file, std::vector<std::string>& notes);

// The outline through corners with z = 0, the last one joined to the first, with the same checks and direction.
SurfaceMesh close_polyline(const std::vector<Vec3>& corners);

namespace mesh {

// Pairs of segments with a common point other than one at which they join, lower index first, in ascending order.
// Exact for the stored coordinates.
std::vector<std::array<int, 2>> crossing_segments(const SurfaceMesh& mesh);

// The exact signed distance from closed polylines.
class PolylineDistance {
 public:
  explicit PolylineDistance(SurfaceMesh polylines);
  PolylineDistance(const PolylineDistance&) = delete;
  PolylineDistance& operator=(const PolylineDistance&) = delete;
  // m, negative inside; x has z = 0. Several threads may ask at once.
  double operator()(const Vec3& x) const;

 private:
  SurfaceMesh mesh_;  // segments as triangles without area
  NearestTriangle nearest_;
};

}  // namespace mesh
}  // namespace seiche
