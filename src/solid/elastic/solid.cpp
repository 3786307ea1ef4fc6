#include "solid/elastic/solid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/expression.h"
#include "solid/elastic/surface_patches.h"
#include "solid/mesh/meshing.h"

namespace seiche {
namespace {

constexpr double on_surface = 1e-6;  // of an element's edge: a pin that ends on a face includes the face's nodes

template <int Dim>
std::vector<int> nodes_in(const PinSpec& pin, const std::string& name, const ElasticMesh<Dim>& mesh,
                          const ShapeOptions& options) {
  double nearest = 0;
  std::vector<int> nodes = nodes_within(mesh, pin.shape, options, nearest);
  if (!nodes.empty()) return nodes;
  throw Error(
      ExitCode::bad_input,
      fmt::format("{}: the pinned shape of solid '{}' contains none of its {} nodes; the nearest lies {:.4g} m outside",
                  pin.shape.where, name, mesh.nodes.size(), nearest));
}

// Removes nodes that earlier pins already hold with the same motion.
template <int Dim>
void drop_held(const PinSpec& pin, const std::string& name, const ElasticMesh<Dim>& mesh,
               const std::vector<PinnedNodes>& earlier, std::vector<int>& nodes) {
  for (const PinnedNodes& other : earlier) {
    std::vector<int> both;
    std::set_intersection(nodes.begin(), nodes.end(), other.nodes.begin(), other.nodes.end(), std::back_inserter(both));
    if (both.empty()) continue;
    if (!same_motion(pin.motion, other.motion)) {
      const Vec3 at = extend<Dim>(mesh.nodes[std::size_t(both[0])]);
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: two pinned shapes of solid '{}' move differently but share {} node(s), the first at "
                              "({:g}, {:g}, {:g}); separate the shapes",
                              pin.shape.where, name, both.size(), at[0], at[1], at[2]));
    }
    std::vector<int> rest;
    std::set_difference(nodes.begin(), nodes.end(), both.begin(), both.end(), std::back_inserter(rest));
    nodes = std::move(rest);
  }
}

template <int Dim>
std::vector<PinnedNodes> find_pins(const SolidSpec& spec, const ElasticMesh<Dim>& mesh, const ShapeOptions& options) {
  std::vector<PinnedNodes> pins;
  for (const PinSpec& pin : spec.elastic.pinned) {
    std::vector<int> nodes = nodes_in<Dim>(pin, spec.name, mesh, options);
    drop_held<Dim>(pin, spec.name, mesh, pins, nodes);
    pins.push_back({std::move(nodes), pin.motion});
  }
  return pins;
}

template <int Dim>
Eigen::VectorXd body_force_at(const ElasticSolid<Dim>& solid, double t) {
  const VectorExpression force(solid.body_force);
  if (force.is_constant() && force(Vec3::Zero(), 0).isZero(0)) return {};
  return body_force<Dim>(solid.body, [&](const Vec<Dim>& X) { return truncate<Dim>(force(extend<Dim>(X), t)); });
}

template <int Dim>
Eigen::VectorXd traction_at(const ElasticSolid<Dim>& solid, const LoadedSides& sides, double t) {
  const VectorExpression stress(sides.stress);
  return traction_force<Dim>(solid.body, sides.faces,
                             [&](const Vec<Dim>& X) { return truncate<Dim>(stress(extend<Dim>(X), t)); });
}

// Element sides with all nodes in the traction's shape.
template <int Dim>
LoadedSides find_sides(const TractionSpec& traction, const std::string& name, const ElasticMesh<Dim>& mesh,
                       const ShapeOptions& options, double edge) {
  const auto shape = make_shape<Dim>(traction.shape, options);
  LoadedSides loaded{{}, traction.stress};
  double nearest = std::numeric_limits<double>::infinity();
  for (BoundaryFace& face : boundary_faces(mesh)) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const int n : face.nodes) farthest = std::max(farthest, (*shape)(mesh.nodes[std::size_t(n)]));
    nearest = std::min(nearest, farthest);
    if (farthest <= on_surface * edge) loaded.faces.push_back(std::move(face));
  }
  if (!loaded.faces.empty()) return loaded;
  throw Error(
      ExitCode::bad_input,
      fmt::format("{}: the traction shape of solid '{}' contains no whole boundary face of an element; the nearest "
                  "face reaches {:.4g} m beyond it; enlarge the shape",
                  traction.shape.where, name, nearest));
}

template <int Dim>
void refuse_infinite_forces(const SolidSpec& spec, const ElasticSolid<Dim>& solid) {
  const auto refuse = [&](const std::string& where, const char* key, const char* place) {
    throw Error(ExitCode::bad_input, fmt::format("{}: {} of solid '{}' is not a finite number everywhere {} at t = 0",
                                                 where, key, spec.name, place));
  };
  if (!body_force_at(solid, 0).allFinite()) refuse(spec.shape.where, "body_force", "in it");
  for (std::size_t n = 0; n < solid.tractions.size(); ++n)
    if (!traction_at(solid, solid.tractions[n], 0).allFinite())
      refuse(spec.elastic.tractions[n].shape.where, "traction", "on its sides");
}

}  // namespace

template <int Dim>
std::vector<int> nodes_within(const ElasticMesh<Dim>& mesh, const ShapeSpec& shape, const ShapeOptions& options,
                              double& nearest) {
  const auto field = make_shape<Dim>(shape, options);
  const double edge = mesh_quality(mesh).shortest_edge;
  std::vector<int> nodes;
  nearest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const double d = (*field)(mesh.nodes[n]);
    nearest = std::min(nearest, d);
    if (d <= on_surface * edge) nodes.push_back(int(n));
  }
  return nodes;
}

bool same_motion(const MotionSpec& a, const MotionSpec& b) {
  return a.translate == b.translate && a.degrees == b.degrees && a.axis == b.axis && a.center == b.center;
}

template <int Dim>
ElasticSolid<Dim> make_elastic_solid(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                                     const Vec<Dim>& upper) {
  const ElasticSpec& e = spec.elastic;
  ElasticSolid<Dim> r;
  r.body = make_elastic_body<Dim>(
      mesh_solid<Dim>(spec, options, lower, upper), elastic_material<Dim>(e.model),
      {spec.rigid.density, lame_of(e.youngs_modulus, e.poisson_ratio), e.mass_damping, e.damping});
  r.surface = surface_of(r.body.mesh);
  r.pins = find_pins<Dim>(spec, r.body.mesh, options);
  r.patches = find_patches<Dim>(r.surface, r.pins);
  r.body_force = e.body_force;
  const double edge = mesh_quality(r.body.mesh).shortest_edge;
  for (const TractionSpec& traction : e.tractions)
    r.tractions.push_back(find_sides<Dim>(traction, spec.name, r.body.mesh, options, edge));
  refuse_infinite_forces<Dim>(spec, r);
  return r;
}

namespace {

template <int Dim>
Pins pins_of_sequence(const ElasticSolid<Dim>& solid, double t) {
  const std::vector<Vec3> points = solid.sequence->points_at(t);
  Pins pins;
  for (std::size_t n = 0; n < points.size(); ++n)
    for (int axis = 0; axis < Dim; ++axis) {
      pins.dofs.push_back(Dim * int(n) + axis);
      pins.targets.push_back(points[n][axis] - solid.body.mesh.nodes[n][axis]);
    }
  return pins;
}

}  // namespace

// u = R(t) (X - c) + c + T(t) - X
template <int Dim>
Pins pins_at(const ElasticSolid<Dim>& solid, double t) {
  if (solid.sequence) return pins_of_sequence(solid, t);
  std::vector<std::pair<int, Vec<Dim>>> held;
  for (const PinnedNodes& pin : solid.pins) {
    const double angle = Expression(pin.motion.degrees)(Vec3::Zero(), t) * std::numbers::pi / 180;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, pin.motion.axis.normalized()).toRotationMatrix();
    const Vec3 moved = VectorExpression(pin.motion.translate)(Vec3::Zero(), t);
    for (const int n : pin.nodes) {
      const Vec3 arm = extend<Dim>(solid.body.mesh.nodes[std::size_t(n)]) - pin.motion.center;
      held.emplace_back(n, truncate<Dim>(Vec3(turn * arm - arm + moved)));
    }
  }
  std::sort(held.begin(), held.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Pins pins;
  for (const auto& [node, u] : held) {
    for (int axis = 0; axis < Dim; ++axis) {
      pins.dofs.push_back(Dim * node + axis);
      pins.targets.push_back(u[axis]);
    }
  }
  return pins;
}

template <int Dim>
Eigen::VectorXd applied_force_at(const ElasticSolid<Dim>& solid, double t) {
  Eigen::VectorXd force = body_force_at(solid, t);
  for (const LoadedSides& sides : solid.tractions) {
    if (force.size() == 0) force.setZero(solid.body.size());
    force += traction_at(solid, sides, t);
  }
  return force;
}

// Measured on blocks of quadratic elements with supernodal factors: 20 n^(4/3) entries in 3D for 10^3 to 10^4 unknowns;
// 6 n log2 n in 2D, a third of that for long strips.
double factor_bytes(int dim, int unknowns) {
  const double n = std::max(unknowns, 2);
  return 8 * (dim == 3 ? 20 * std::pow(n, 4. / 3) : 6 * n * std::log2(n));
}

template <int Dim>
std::string describe_mesh(const std::string& name, const ElasticMesh<Dim>& mesh) {
  const MeshQuality q = mesh_quality(mesh);
  return fmt::format(
      "solid '{}': {} nodes, {} {} {}, edges {:.4g} to {:.4g} m, quality {:.3f} at worst, {:.3f} in the mean", name,
      q.nodes, q.elements, mesh.order == 1 ? "linear" : "quadratic", Dim == 2 ? "triangles" : "tetrahedra",
      q.shortest_edge, q.longest_edge, q.worst, q.mean);
}

#define SEICHE_INSTANTIATE(Dim)                                                                               \
  template ElasticSolid<Dim> make_elastic_solid<Dim>(const SolidSpec&, const ShapeOptions&, const Vec<Dim>&,  \
                                                     const Vec<Dim>&);                                        \
  template std::vector<int> nodes_within<Dim>(const ElasticMesh<Dim>&, const ShapeSpec&, const ShapeOptions&, \
                                              double&);                                                       \
  template Pins pins_at<Dim>(const ElasticSolid<Dim>&, double);                                               \
  template Eigen::VectorXd applied_force_at<Dim>(const ElasticSolid<Dim>&, double);                           \
  template std::string describe_mesh<Dim>(const std::string&, const ElasticMesh<Dim>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
