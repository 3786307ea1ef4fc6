#pragma once
// Bounding volume hierarchy of the triangles of a frame's solids.
#include <cstdint>
#include <vector>

#include "files/solid_mesh.h"
#include "render/volume.h"

namespace seiche::render {

struct Triangle {
  Vec3f corner, edge1, edge2;    // corners: corner, corner + edge1, corner + edge2
  std::array<Vec3f, 3> normals;  // smoothed over shallow creases
  int solid = 0;
};

struct Hit {
  float t = -1;        // negative: none
  float u = 0, v = 0;  // barycentric weights of edge1 and edge2
  std::uint32_t triangle = 0;
};

class Bvh {
 public:
  Bvh() = default;
  explicit Bvh(std::vector<Triangle> triangles);
  // Nearest hit with t0 < t < t1.
  Hit closest(const Ray& ray, float t0, float t1) const;
  bool any(const Ray& ray, float t0, float t1) const;
  const Triangle& triangle(std::uint32_t index) const { return triangles_[index]; }
  bool empty() const { return triangles_.empty(); }

 private:
  struct Node {
    Box box;
    std::uint32_t first = 0, count = 0;  // leaf: triangles; inner (count 0): first = index of the high child
  };
  void build(std::uint32_t begin, std::uint32_t end);
  template <class Visit>
  void walk(const Ray& ray, float t0, float& t1, Visit visit) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

// Ray against one triangle, both sides (Moller, Trumbore 1997).
Hit intersect(const Ray& ray, const Triangle& triangle);

// Triangles with vertex normals averaged over adjacent triangles at less than 40 degrees.
std::vector<Triangle> smooth_triangles(const SolidMesh& solids);

}  // namespace seiche::render
