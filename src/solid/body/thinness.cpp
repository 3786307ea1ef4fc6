#include "solid/body/thinness.h"

#include <limits>

#include "geometry/mesh/distance.h"

namespace seiche {
namespace {

// Limits the time to about a second.
constexpr double most_samples = 2e7, most_samples_of_mesh = 2e6;

// Slightly below h/2, so that a ball fits despite round-off.
constexpr double radius = 0.499;  // of h

// Surface as triangles; segments (2D) become triangles without area.
template <int Dim>
SurfaceMesh as_triangles(SurfaceMesh mesh) {
  for (const auto& [a, b] : mesh.segments) mesh.triangles.push_back({a, b, b});
  return mesh;
}

// Sample points of an element: corners, edge middles and the centroid.
template <int Dim>
std::vector<Vec<Dim>> samples_of(const ElasticMesh<Dim>& mesh, int e) {
  std::vector<Vec<Dim>> samples;
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (int i = 0; i <= Dim; ++i) {
    const Vec<Dim>& x = mesh.nodes[std::size_t(mesh.element(e)[i])];
    for (int j = 0; j <= i; ++j) samples.push_back(0.5 * (x + mesh.nodes[std::size_t(mesh.element(e)[j])]));
    sum += x;
  }
  samples.push_back(sum / (Dim + 1));
  return samples;
}

// Number of samples along each axis, a quarter of a cell apart or less, with one in the middle.
template <int Dim>
Vec<Dim> samples_across(const Vec<Dim>& low, const Vec<Dim>& high, double h) {
  return 2 * ((high - low) / (h / 2)).array().ceil() + 1;
}

}  // namespace

template <int Dim>
bool is_thinner_than(const ElasticSolid<Dim>& solid, double h) {
  const SurfaceMesh surface = as_triangles<Dim>(solid.surface.facets);
  const mesh::NearestTriangle nearest(surface);
  const ElasticMesh<Dim>& mesh = solid.body.mesh;
  for (int e = 0; e < mesh.element_count(); ++e)
    for (const Vec<Dim>& x : samples_of(mesh, e))
      if (nearest.distance(extend<Dim>(x), h) >= radius * h) return false;
  return true;
}

template <int Dim>
bool is_thinner_than(const Body<Dim>& body, double h, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  // A container, the outside of a shape, goes on beyond the domain.
  if (body.spec().shape.kind == "expression" || body.spec().shape.invert) return false;
  const double most = body.spec().shape.has_facets() ? most_samples_of_mesh : most_samples;
  Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& x : body.contact_surface().points) {
    low = low.cwiseMin(truncate<Dim>(x));
    high = high.cwiseMax(truncate<Dim>(x));
  }
  if (low[0] > high[0]) return false;
  if (samples_across(low, high, h).prod() > most) {
    constexpr double beyond = 2;  // cells: thickness beyond the sides counts
    const Vec<Dim> margin = Vec<Dim>::Constant(beyond * h);
    low = low.cwiseMax(lower - margin), high = high.cwiseMin(upper + margin);
  }
  const Vec<Dim> count = samples_across(low, high, h);
  if ((high - low).minCoeff() < 0 || count.prod() > most) return false;
  for (int n = 0; n < int(count.prod()); ++n) {
    Vec<Dim> x = low;
    for (int a = 0, rest = n; a < Dim; rest /= int(count[a]), ++a)
      x[a] += (high[a] - low[a]) * (rest % int(count[a])) / std::max(1.0, count[a] - 1);
    if (body.distance_at_rest(x) < -radius * h) return false;
  }
  return true;
}

template bool is_thinner_than<2>(const ElasticSolid<2>&, double);
template bool is_thinner_than<3>(const ElasticSolid<3>&, double);
template bool is_thinner_than<2>(const Body<2>&, double, const Vec<2>&, const Vec<2>&);
template bool is_thinner_than<3>(const Body<3>&, double, const Vec<3>&, const Vec<3>&);

}  // namespace seiche
