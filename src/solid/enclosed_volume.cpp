#include "solid/enclosed_volume.h"

#include <Eigen/Geometry>
#include <cmath>

namespace seiche {
namespace {

template <int Dim>
const std::vector<std::array<int, Dim>>& facets_of(const SurfaceMesh& mesh) {
  if constexpr (Dim == 2)
    return mesh.segments;
  else
    return mesh.triangles;
}

// Volume between a facet and the origin, and its derivative by corner i.
double cone(const std::array<Vec<2>, 2>& p) {
  return 0.5 * (p[0][0] * p[1][1] - p[0][1] * p[1][0]);
}
double cone(const std::array<Vec<3>, 3>& p) {
  return p[0].dot(p[1].cross(p[2])) / 6;
}
Vec<2> cone_gradient(const std::array<Vec<2>, 2>& p, int i) {
  return i == 0 ? Vec<2>(0.5 * p[1][1], -0.5 * p[1][0]) : Vec<2>(-0.5 * p[0][1], 0.5 * p[0][0]);
}
Vec<3> cone_gradient(const std::array<Vec<3>, 3>& p, int i) {
  return p[(i + 1) % 3].cross(p[(i + 2) % 3]) / 6;
}

// visit(facet, corners) of a part, the corners seen from one of its points.
template <int Dim, class Visit>
void for_each_facet(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u, const Visit& visit) {
  const std::vector<Vec<Dim>> points = surface_points(solid, u);
  const Vec<Dim>* origin = nullptr;
  for (const auto& facet : facets_of<Dim>(solid.surface.facets)) {
    if (solid.surface.part[std::size_t(facet[0])] != part) continue;
    if (!origin) origin = &points[std::size_t(facet[0])];
    std::array<Vec<Dim>, Dim> p;
    for (int i = 0; i < Dim; ++i) p[i] = points[std::size_t(facet[i])] - *origin;
    visit(facet, p);
  }
}

// Unit normals of a part's nodes, zero where they are held.
template <int Dim>
Eigen::VectorXd free_normals(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u, double t) {
  Eigen::VectorXd normals = enclosed_volume_gradient(solid, part, u);
  for (Eigen::Index n = 0; n < normals.size(); n += Dim)
    if (const double area = normals.segment<Dim>(n).norm(); area > 0) normals.segment<Dim>(n) /= area;
  for (const int dof : pins_at(solid, t).dofs) normals[dof] = 0;
  return normals;
}

}  // namespace

template <int Dim>
double enclosed_volume(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u) {
  double sum = 0;
  for_each_facet(solid, part, u, [&](const auto&, const std::array<Vec<Dim>, Dim>& p) { sum += cone(p); });
  return sum;
}

template <int Dim>
Eigen::VectorXd enclosed_volume_gradient(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(u.size());
  for_each_facet(solid, part, u, [&](const auto& facet, const std::array<Vec<Dim>, Dim>& p) {
    for (int i = 0; i < Dim; ++i)
      gradient.segment<Dim>(Dim * solid.surface.nodes[std::size_t(facet[i])]) += cone_gradient(p, i);
  });
  return gradient;
}

template <int Dim>
std::vector<int> parts_of_nodes(const ElasticSolid<Dim>& solid) {
  std::vector<int> parts(solid.body.mesh.nodes.size(), -1);
  for (std::size_t n = 0; n < solid.surface.nodes.size(); ++n)
    parts[std::size_t(solid.surface.nodes[n])] = solid.surface.part[n];
  return parts;
}

template <int Dim>
SurfaceMesh wall_of_cavity(const ElasticSolid<Dim>& solid, int part) {
  SurfaceMesh wall;
  for (const auto& facet : facets_of<Dim>(solid.surface.facets)) {
    if (solid.surface.part[std::size_t(facet[0])] != part) continue;
    if constexpr (Dim == 2)
      wall.segments.push_back({facet[1], facet[0]});
    else
      wall.triangles.push_back({facet[0], facet[2], facet[1]});
  }
  return wall;
}

template <int Dim>
Eigen::VectorXd velocity_over(const ElasticSolid<Dim>& solid, const ElasticMotion& motion, double t, double dt,
                              double horizon) {
  constexpr int iterations = 4;  // Newton's; what is missing is small of second order in the motion, two are enough
  Eigen::VectorXd w = motion.velocity;
  const Eigen::VectorXd& u = motion.state.u;
  for (int part = 0; part < int(motion.kept_volume.size()) && dt != horizon; ++part) {
    if (!std::isfinite(motion.kept_volume[part])) continue;
    const double now = enclosed_volume(solid, part, u);
    const double planned = enclosed_volume(solid, part, Eigen::VectorXd(u + horizon * motion.velocity));
    const double wanted = now + dt / horizon * (planned - now);
    for (int n = 0; n < iterations; ++n) {
      const Eigen::VectorXd end = u + dt * w, normals = free_normals(solid, part, end, t + dt);
      const double slope = enclosed_volume_gradient(solid, part, end).dot(normals);
      if (slope > 0) w += (wanted - enclosed_volume(solid, part, end)) / (slope * dt) * normals;
    }
  }
  return w;
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template double enclosed_volume<D>(const ElasticSolid<D>&, int, const Eigen::VectorXd&);                   \
  template Eigen::VectorXd enclosed_volume_gradient<D>(const ElasticSolid<D>&, int, const Eigen::VectorXd&); \
  template std::vector<int> parts_of_nodes<D>(const ElasticSolid<D>&);                                       \
  template SurfaceMesh wall_of_cavity<D>(const ElasticSolid<D>&, int);                                       \
  template Eigen::VectorXd velocity_over<D>(const ElasticSolid<D>&, const ElasticMotion&, double, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
