#pragma once
// The distance of points to the nearest of many triangles.
#include <vector>

#include "levelset/mesh.h"

namespace seiche::mesh {

// The least distance of x to the triangle a, b, c (m).
double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

// A tree of boxes over the triangles of a mesh, which must outlive it. Any number of threads may ask at once.
class NearestTriangle {
 public:
  explicit NearestTriangle(const SurfaceMesh& mesh);
  // The distance of x to the surface, or `bound` if that is less (m).
  double distance(const Vec3& x, double bound) const;

 private:
  // The triangles order_[first] up to order_[last]; children follow at `low` and `low + 1`, none if low is 0.
  struct Node {
    Vec3 lower, upper;
    int first = 0, last = 0, low = 0;
  };
  void split(int node, const std::vector<Vec3>& centers);
  Node enclose(int first, int last) const;

  const SurfaceMesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace seiche::mesh
