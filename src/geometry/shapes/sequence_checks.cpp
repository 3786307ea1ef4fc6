#include "geometry/shapes/sequence_checks.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "base/error.h"
#include "geometry/mesh/intersections.h"
#include "geometry/mesh/polyline.h"
#include "geometry/shapes/mesh_sequence.h"

namespace seiche {
namespace {

constexpr double most_facets = 4e6;      // that are looked at in all: some six seconds of one core
constexpr int most_parts = 8;            // of the way from one mesh to the next; looks lie between them
constexpr double collapsed_share = 0.1;  // of the smaller volume of the two meshes

bool is_flat(const SurfaceMesh& mesh) {
  return mesh.triangles.empty();
}

// Volume of a closed surface, signed (2D: area).
double volume_within(const SurfaceMesh& mesh) {
  const Vec3 origin = mesh.points[0];
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += (mesh.points[std::size_t(t[0])] - origin)
               .cross(mesh.points[std::size_t(t[1])] - origin)
               .dot(mesh.points[std::size_t(t[2])] - origin) /
           6;
  for (const auto& s : mesh.segments)
    sum += (mesh.points[std::size_t(s[0])] - origin).cross(mesh.points[std::size_t(s[1])] - origin)[2] / 2;
  return sum;
}

// Reason why a surface is none between two of these volumes, or empty.
std::string fault_of_surface(const SurfaceMesh& mesh, double least_volume) {
  const double volume = volume_within(mesh);
  if (volume < collapsed_share * least_volume)
    return fmt::format("the surface collapses or turns inside out, its volume is {:.3g} and that of the meshes {:.3g}",
                       volume, least_volume);
  const auto pairs = is_flat(mesh) ? mesh::crossing_segments(mesh) : mesh::self_intersections(mesh);
  return pairs.empty() ? "" : fmt::format("the surface crosses itself, in {} pairs of facets", pairs.size());
}

}  // namespace

void require_simple_between(const MeshSequence& sequence, const std::vector<std::filesystem::path>& files,
                            const std::string& where) {
  SurfaceMesh mesh = sequence.first();
  const int last = sequence.count() - (sequence.loops() ? 0 : 1);
  const double facets = double(mesh.triangles.size() + mesh.segments.size());
  int parts = most_parts;
  while (parts > 2 && parts * facets * last > most_facets) parts /= 2;
  const auto volume_of_mesh = [&](int k) {
    mesh.points = sequence.points_of(k);
    return std::abs(volume_within(mesh));
  };
  for (int k = 0; k < last; ++k) {
    const int next = (k + 1) % sequence.count();
    if (sequence.points_of(k) == sequence.points_of(next)) continue;
    const double least = std::min(volume_of_mesh(k), volume_of_mesh(next));
    const MeshPassage passage = sequence.passage_after(k);
    for (int part = 1; part < parts; ++part) {
      const double t = sequence.time_of(k + double(part) / parts);
      mesh.points = passage.at(double(part) / parts);
      const std::string fault = fault_of_surface(mesh, least);
      if (!fault.empty())
        throw Error(ExitCode::bad_input,
                    fmt::format("{}: between {} and {}, at t = {:g} s, {}; add meshes in between, or move its points "
                                "less from one to the next",
                                where, files[std::size_t(k)].filename().string(),
                                files[std::size_t(next)].filename().string(), t, fault));
    }
  }
}

}  // namespace seiche
