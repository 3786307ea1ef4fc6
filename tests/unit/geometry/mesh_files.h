#pragma once
// Surfaces for tests of mesh readers, and their files in every format.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "unit/files/scratch.h"

namespace seiche::mesh_files {

using TemporaryFolder = ScratchFolder;

// ---- surfaces -------------------------------------------------------------------------------------------------

inline SurfaceMesh cube(const Vec3& lower = Vec3(0, 0, 0), double size = 1) {
  SurfaceMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back(lower + size * Vec3(i & 1, (i >> 1) & 1, i >> 2));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline SurfaceMesh subdivide(const SurfaceMesh& coarse, const Vec3& center, double radius) {
  SurfaceMesh fine{coarse.points, {}, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), int(fine.points.size()));
    if (is_new) {
      const Vec3 p = (fine.points[a] + fine.points[b]) / 2 - center;
      fine.points.push_back(center + radius * p.normalized());
    }
    return entry->second;
  };
  for (const auto& t : coarse.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    for (const auto& part :
         {std::array{t[0], a, c}, std::array{a, t[1], b}, std::array{c, b, t[2]}, std::array{a, b, c}}) {
      fine.triangles.push_back(part);
    }
  }
  return fine;
}

// An octahedron refined towards the sphere.
inline SurfaceMesh sphere(const Vec3& center, double radius, int refinements) {
  SurfaceMesh mesh;
  for (int a = 0; a < 3; ++a) {
    mesh.points.push_back(center - radius * Vec3::Unit(a));
    mesh.points.push_back(center + radius * Vec3::Unit(a));
  }
  for (int octant = 0; octant < 8; ++octant) {
    std::array<int, 3> t{octant & 1, 2 + ((octant >> 1) & 1), 4 + (octant >> 2)};
    if (((octant & 1) + ((octant >> 1) & 1) + (octant >> 2)) % 2 == 0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  for (int i = 0; i < refinements; ++i) mesh = subdivide(mesh, center, radius);
  return mesh;
}

inline SurfaceMesh joined(SurfaceMesh a, const SurfaceMesh& b) {
  const int n = int(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

inline double volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
  return sum;
}

// ---- files ----------------------------------------------------------------------------------------------------

inline std::string obj(const SurfaceMesh& mesh) {
  std::string text = "# test\r\nmtllib none.mtl\r\n";
  for (const Vec3& p : mesh.points) text += fmt::format("v {} {} {}\r\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) text += fmt::format("f {}/1/1 {}//2 {}\r\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

inline std::string relative_obj(const SurfaceMesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.points) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  const int n = int(mesh.points.size());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] - n, t[1] - n, t[2] - n);
  return text;
}

inline std::string ply_header(const SurfaceMesh& mesh, const std::string& format, const std::string& faces) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment test\nelement vertex {}\nproperty double x\nproperty uchar shade\n"
      "property float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      format, mesh.points.size(), faces);
}

template <class Number>
void put(std::string& bytes, Number value, bool big_endian) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  if (big_endian) std::reverse(raw, raw + sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

inline std::string binary_ply(const SurfaceMesh& mesh, const std::string& endian) {
  const bool big = endian == "big";
  std::string bytes = ply_header(mesh, "binary_" + endian + "_endian", std::to_string(mesh.triangles.size()));
  for (const Vec3& p : mesh.points) {
    put(bytes, p[0], big);
    put(bytes, char(9), big);
    put(bytes, float(p[1]), big);
    put(bytes, float(p[2]), big);
  }
  for (const auto& t : mesh.triangles) {
    put(bytes, char(3), big);
    for (const int corner : t) put(bytes, corner, big);
  }
  return bytes;
}

inline std::string ascii_ply(const SurfaceMesh& mesh) {
  std::string text = ply_header(mesh, "ascii", std::to_string(mesh.triangles.size()));
  for (const Vec3& p : mesh.points) text += fmt::format("{} 9 {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

inline std::string ascii_stl(const SurfaceMesh& mesh) {
  std::string text = "solid a name of words\n";
  for (const auto& t : mesh.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const int corner : t) {
      const Vec3& p = mesh.points[corner];
      text += fmt::format("  vertex {} {} {}\n", p[0], p[1], p[2]);
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid a name of words\n";
}

inline std::string binary_stl(const SurfaceMesh& mesh, const std::string& title = "solid but binary") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  put(bytes, std::uint32_t(mesh.triangles.size()), false);
  for (const auto& t : mesh.triangles) {
    bytes.append(12, '\0');
    for (const int corner : t) {
      for (int a = 0; a < 3; ++a) put(bytes, float(mesh.points[corner][a]), false);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace seiche::mesh_files
