#include "geometry/shapes/mesh_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbered_files.h"
#include "base/solid_spec.h"
#include "geometry/shapes/makers.h"
#include "geometry/shapes/sequence_checks.h"

namespace seiche {
namespace {

template <class Facet>
bool same_corners(Facet a, Facet b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

// Reason why facets are not those of the first mesh, or empty.
template <class Facet>
std::string fault_of_facets(const std::vector<Facet>& first, const std::vector<Facet>& facets, const char* name) {
  if (facets.size() != first.size()) return fmt::format("has {} {}s, the first {}", facets.size(), name, first.size());
  const auto [at, there] = std::mismatch(facets.begin(), facets.end(), first.begin());
  if (at == facets.end()) return {};
  if (same_corners(*at, *there)) return "is turned inside out";
  return fmt::format("joins other points in {} {} than the first", name, at - facets.begin());
}

// Reason why a mesh cannot follow the first, or empty.
std::string fault_of_topology(const SurfaceMesh& first, const SurfaceMesh& mesh) {
  if (mesh.points.size() != first.points.size())
    return fmt::format("has {} points, the first {}", mesh.points.size(), first.points.size());
  const std::string fault = fault_of_facets(first.triangles, mesh.triangles, "triangle");
  return fault.empty() ? fault_of_facets(first.segments, mesh.segments, "line") : fault;
}

// Cubic with the values a, b and the slopes p, q at s = 0 and 1.
Vec3 hermite(const Vec3& a, const Vec3& p, const Vec3& b, const Vec3& q, double s) {
  const double r = 1 - s;
  return r * r * ((1 + 2 * s) * a + s * p) + s * s * ((1 + 2 * r) * b - r * q);
}

}  // namespace

std::vector<Vec3> MeshPassage::at(double share) const {
  std::vector<Vec3> points;
  points.reserve(from_.size());
  for (std::size_t p = 0; p < from_.size(); ++p)
    points.push_back(hermite(from_[p], slopes_[p], to_[p], next_slopes_[p], share));
  return points;
}

MeshSequence::MeshSequence(int dimension, const ShapeSpec& shape, const SequenceSpec& spec, const ShapeOptions& options)
    : rate_(spec.rate), start_(spec.start), loops_(spec.loop) {
  ShapeSpec one = shape;
  const std::vector<std::filesystem::path> files = numbered_files(shape.file, spec.meshes);
  for (const std::filesystem::path& file : files) {
    one.file = file;
    SurfaceMesh mesh;
    try {
      mesh = dimension == 2 ? shape::read_shape_mesh<2>(one, options) : shape::read_shape_mesh<3>(one, options);
    } catch (const Error& e) {
      throw Error(e.code(), shape.where + ": " + e.what());
    }
    if (points_.empty()) first_ = mesh;
    const std::string fault = fault_of_topology(first_, mesh);
    if (!fault.empty())
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: {} {}; all meshes of a sequence must join the same points in the same order",
                              shape.where, file.string(), fault));
    points_.push_back(std::move(mesh.points));
  }
  require_simple_between(*this, files, shape.where);
}

// Without a loop the sequence goes back at its ends, where the slopes are zero then.
int MeshSequence::index(int k) const {
  const int n = count(), period = loops_ ? n : 2 * (n - 1), at = (k % period + period) % period;
  return at < n ? at : period - at;
}

// Slopes per mesh of the cubic splines through the points: 3 sum_j -(-a)^j (x_k+j - x_k-j), a = 2 - sqrt(3).
std::vector<Vec3> MeshSequence::slopes_at(int k) const {
  constexpr int reach = 24;  // a^24 = 2e-14
  const double a = 2 - std::sqrt(3.0);
  std::vector<Vec3> slopes(first_.points.size(), Vec3::Zero());
  double weight = 3 * a;
  for (int j = 1; j <= reach; ++j, weight *= -a) {
    const auto &later = points_[std::size_t(index(k + j))], &earlier = points_[std::size_t(index(k - j))];
    for (std::size_t p = 0; p < slopes.size(); ++p) slopes[p] += weight * (later[p] - earlier[p]);
  }
  return slopes;
}

MeshPassage MeshSequence::passage_after(int mesh) const {
  return {points_[std::size_t(index(mesh))], slopes_at(mesh), points_[std::size_t(index(mesh + 1))],
          slopes_at(mesh + 1)};
}

std::vector<Vec3> MeshSequence::points_at(double t) const {
  double s = (t - start_) * rate_;
  s = loops_ ? std::fmod(s, count()) : std::clamp(s, 0.0, double(count() - 1));
  const int k = int(std::floor(s));
  return passage_after(k).at(s - k);
}

}  // namespace seiche
