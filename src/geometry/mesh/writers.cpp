#include "geometry/mesh/writers.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <iterator>

namespace seiche::mesh {
namespace {

template <class T>
void put(std::string& bytes, const T& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::string property_lines(const PointAttribute& attribute) {
  if (attribute.components == 1) return fmt::format("property float {}\n", attribute.name);
  const std::string stem = attribute.name == "velocity" ? "v" : attribute.name + "_";
  return fmt::format("property float {0}x\nproperty float {0}y\nproperty float {0}z\n", stem);
}

std::string ply_header(const SurfaceMesh& mesh, const std::vector<PointAttribute>& attributes,
                       const std::string& comment) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      comment, mesh.points.size());
  for (const PointAttribute& attribute : attributes) header += property_lines(attribute);
  return header +
         fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
}

}  // namespace

std::string encode_ply(const SurfaceMesh& mesh, const std::vector<PointAttribute>& attributes,
                       const std::string& comment) {
  std::string bytes = ply_header(mesh, attributes, comment);
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    for (int a = 0; a < 3; ++a) put(bytes, float(mesh.points[n][a]));
    for (const PointAttribute& attribute : attributes) {
      const auto width = std::size_t(attribute.components);
      for (std::size_t a = 0; a < width; ++a) put(bytes, attribute.values[width * n + a]);
    }
  }
  for (const auto& triangle : mesh.triangles) {
    put(bytes, std::uint8_t(3));
    for (const int corner : triangle) put(bytes, std::int32_t(corner));
  }
  return bytes;
}

std::string encode_obj(const SurfaceMesh& mesh, const std::string& name, const std::string& comment) {
  std::string text = fmt::format("# {}\no {}\n", comment, name);
  const auto out = std::back_inserter(text);
  for (const Vec3& p : mesh.points) fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

}  // namespace seiche::mesh
