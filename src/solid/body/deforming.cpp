#include "solid/body/deforming.h"

#include <Eigen/Geometry>
#include <map>

#include "base/disjoint_sets.h"
#include "geometry/mesh/facets.h"
#include "solid/body/mass_properties.h"
#include "solid/elastic/surface_patches.h"

namespace seiche {
namespace {

constexpr double density = 1;  // kg/m^3, a thousandth of water's: prescribed nodes never feel their mass

// One linear side for each facet.
template <int Dim>
std::vector<BoundaryFace> sides_of(const SurfaceMesh& surface) {
  std::vector<BoundaryFace> sides;
  for (const auto& facet : facets_of<Dim>(surface)) sides.push_back({0, {facet.begin(), facet.end()}});
  return sides;
}

// Numbers the connected parts of the points in the order of their smallest point.
template <int Dim>
void number_connected(ElasticSurface& surface) {
  DisjointSets sets(surface.nodes.size());
  for (const auto& facet : facets_of<Dim>(surface.facets))
    for (int i = 1; i < Dim; ++i) sets.join(facet[0], facet[std::size_t(i)]);
  std::map<int, int> number;
  for (std::size_t p = 0; p < surface.nodes.size(); ++p)
    surface.part.push_back(number.try_emplace(sets.root(int(p)), int(number.size())).first->second);
  surface.parts = int(number.size());
}

template <int Dim>
ElasticSurface surface_of_mesh(const SurfaceMesh& mesh) {
  ElasticSurface surface{mesh, sides_of<Dim>(mesh), {}, {}, 0};
  for (std::size_t p = 0; p < mesh.points.size(); ++p) surface.nodes.push_back(int(p));
  number_connected<Dim>(surface);
  return surface;
}

// Length (2D) or area of a facet.
double area_of(const SurfaceMesh& mesh, const std::array<int, 2>& ends) {
  return (mesh.points[std::size_t(ends[1])] - mesh.points[std::size_t(ends[0])]).norm();
}

double area_of(const SurfaceMesh& mesh, const std::array<int, 3>& corners) {
  const Vec3 &a = mesh.points[std::size_t(corners[0])], &b = mesh.points[std::size_t(corners[1])],
             &c = mesh.points[std::size_t(corners[2])];
  return (b - a).cross(c - a).norm() / 2;
}

// The area of each facet goes to its corners in equal parts.
template <int Dim>
Eigen::VectorXd areas_of_points(const SurfaceMesh& mesh) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(Eigen::Index(mesh.points.size()));
  for (const auto& facet : facets_of<Dim>(mesh))
    for (const int p : facet) areas[p] += area_of(mesh, facet) / Dim;
  return areas;
}

// The volume within the surface as mass, shared by area.
template <int Dim>
ElasticBody<Dim> body_of_points(const SurfaceMesh& mesh) {
  ElasticBody<Dim> body;
  for (const Vec3& x : mesh.points) body.mesh.nodes.push_back(truncate<Dim>(x));
  body.properties.density = density;
  const Eigen::VectorXd areas = areas_of_points<Dim>(mesh);
  const double mass = density * mass_of_surface<Dim>(mesh, 1).volume;
  body.lumped_mass.resize(body.size());
  for (int i = 0; i < body.size(); ++i) body.lumped_mass[i] = mass * areas[i / Dim] / areas.sum();
  body.mass.resize(body.size(), body.size());
  body.mass.setIdentity();
  body.mass = body.lumped_mass.asDiagonal() * body.mass;
  body.pattern.resize(body.size(), body.size());
  return body;
}

}  // namespace

template <int Dim>
ElasticSolid<Dim> make_deforming_solid(const SolidSpec& spec, const ShapeOptions& options) {
  ElasticSolid<Dim> solid;
  solid.sequence = std::make_shared<const MeshSequence>(Dim, spec.shape, spec.sequence, options);
  solid.body = body_of_points<Dim>(solid.sequence->first());
  solid.surface = surface_of_mesh<Dim>(solid.sequence->first());
  solid.patches = find_patches<Dim>(solid.surface, {});
  solid.body_force = {"0", "0", "0"};
  return solid;
}

template ElasticSolid<2> make_deforming_solid<2>(const SolidSpec&, const ShapeOptions&);
template ElasticSolid<3> make_deforming_solid<3>(const SolidSpec&, const ShapeOptions&);

}  // namespace seiche
