#include "solid/mesh/point.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/probe_spec.h"
#include "linalg/core/dense_factors.h"

namespace seiche {
namespace {

constexpr double still_on_side = 0.02;  // of an edge
constexpr double inside = 1e-9;         // of lambda: points on a side belong to the element

template <int Dim>
Vec<Dim> position(const ElasticMesh<Dim>& mesh, int element, const Eigen::VectorXd& weights) {
  Vec<Dim> x = Vec<Dim>::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a)
    x += weights[a] * mesh.nodes[std::size_t(mesh.element(element)[a])];
  return x;
}

// Reference coordinates of the point nearest to X on the flat simplex between an element's corners. It is the nearest
// of the projections onto corners, edges, sides and the simplex that lie within these.
template <int Dim>
Eigen::VectorXd nearest_on_corners(const ElasticMesh<Dim>& mesh, int element, const Vec<Dim>& X) {
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(Dim + 1);
  for (unsigned subset = 1; subset < 1u << (Dim + 1); ++subset) {
    std::vector<int> corners;
    for (int c = 0; c <= Dim; ++c) {
      if (subset >> c & 1) corners.push_back(c);
    }
    const Vec<Dim> from = mesh.nodes[std::size_t(mesh.element(element)[corners[0]])];
    Eigen::MatrixXd edges(Dim, Eigen::Index(corners.size()) - 1);
    for (Eigen::Index k = 0; k < edges.cols(); ++k)
      edges.col(k) = mesh.nodes[std::size_t(mesh.element(element)[corners[std::size_t(k) + 1]])] - from;
    const Vec<Dim> arm = X - from;
    Eigen::VectorXd share;
    if (edges.cols() > 0) share = least_squares(edges, arm);
    const double distance = share.size() > 0 ? (arm - edges * share).norm() : arm.norm();
    if ((share.size() > 0 && (share.minCoeff() < 0 || share.sum() > 1)) || distance >= least) continue;
    least = distance;
    best.setZero();
    best[corners[0]] = 1 - share.sum();
    for (Eigen::Index k = 0; k < share.size(); ++k) best[corners[std::size_t(k) + 1]] = share[k];
  }
  return best.tail(Dim);
}

// Newton's method for X(xi) = X. Straight elements need one step, curved ones few.
template <int Dim>
Eigen::VectorXd reference_place(const ElasticMesh<Dim>& mesh, int element, const Vec<Dim>& X) {
  Eigen::VectorXd xi = Eigen::VectorXd::Constant(Dim, 1. / (Dim + 1));
  for (int i = 0; i < 20; ++i) {
    Eigen::Matrix<double, Dim, Dim> map = Eigen::Matrix<double, Dim, Dim>::Zero();
    const Eigen::MatrixXd gradients = elastic::shape_gradients(Dim, mesh.order, xi);
    for (int a = 0; a < mesh.nodes_per_element(); ++a)
      map += mesh.nodes[std::size_t(mesh.element(element)[a])] * gradients.row(a);
    const Vec<Dim> miss = X - position(mesh, element, elastic::shape_values(Dim, mesh.order, xi));
    const Vec<Dim> step = least_squares(map, miss);
    xi += step;
    if (!(step.norm() > 1e-14)) break;
    if (xi.cwiseAbs().maxCoeff() > 10) break;  // far outside, where the map may not be invertible
  }
  return xi;
}

// Distance from X to the bounding box of an element's nodes.
template <int Dim>
double distance_to_box(const ElasticMesh<Dim>& mesh, int element, const Vec<Dim>& X) {
  Vec<Dim> low = mesh.nodes[std::size_t(mesh.element(element)[0])], high = low;
  for (int a = 1; a < mesh.nodes_per_element(); ++a) {
    low = low.cwiseMin(mesh.nodes[std::size_t(mesh.element(element)[a])]);
    high = high.cwiseMax(mesh.nodes[std::size_t(mesh.element(element)[a])]);
  }
  return (X - X.cwiseMax(low).cwiseMin(high)).norm();
}

}  // namespace

template <int Dim>
MaterialPoint locate(const ElasticMesh<Dim>& mesh, const Vec<Dim>& X) {
  MaterialPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  const double size = mesh_quality(mesh).longest_edge;
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (distance_to_box(mesh, e, X) >= best.distance) continue;
    const Eigen::VectorXd xi = reference_place(mesh, e, X);
    const bool holds = xi.minCoeff() >= -inside && xi.sum() <= 1 + inside;
    const Eigen::VectorXd weights = elastic::shape_values(Dim, mesh.order, holds ? xi : nearest_on_corners(mesh, e, X));
    const double distance = (position(mesh, e, weights) - X).norm();
    if (distance < best.distance) best = {e, weights, distance};
    if (distance <= inside * size) break;
  }
  return best;
}

template <int Dim>
MaterialPoint point_of_probe(const ElasticMesh<Dim>& mesh, const ProbeSpec& probe) {
  const MaterialPoint point = locate<Dim>(mesh, truncate<Dim>(probe.position));
  if (point.distance <= still_on_side * mesh_quality(mesh).longest_edge) return point;
  const Vec3 nearest = extend<Dim>(position(mesh, point.element, point.weights));
  std::string place = fmt::format("{:g}, {:g}", nearest[0], nearest[1]);
  if (Dim == 3) place += fmt::format(", {:g}", nearest[2]);
  throw Error(ExitCode::bad_input,
              fmt::format("{}: probe '{}' lies {:.4g} m outside solid '{}' at rest; the nearest point of it is ({})",
                          probe.where, probe.name, point.distance, probe.solid, place));
}

template <int Dim>
Vec<Dim> interpolate(const ElasticMesh<Dim>& mesh, const MaterialPoint& point, const Eigen::VectorXd& values) {
  Vec<Dim> r = Vec<Dim>::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a)
    r += point.weights[a] * values.segment<Dim>(Dim * mesh.element(point.element)[a]);
  return r;
}

#define SEICHE_INSTANTIATE(Dim)                                                          \
  template MaterialPoint locate<Dim>(const ElasticMesh<Dim>&, const Vec<Dim>&);          \
  template MaterialPoint point_of_probe<Dim>(const ElasticMesh<Dim>&, const ProbeSpec&); \
  template Vec<Dim> interpolate<Dim>(const ElasticMesh<Dim>&, const MaterialPoint&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
