#include "solid/mesh/fit.h"

#include <algorithm>
#include <limits>
#include <set>

namespace seiche {
namespace {

constexpr double furthest = 1. / 3;     // of the shortest edge at a node
constexpr double least_kept = 1. / 3;   // of an element's Jacobian
constexpr double difference = 1e-4;     // of an edge, for central differences: truncation and round-off below 1e-8
constexpr double exact_enough = 1e-12;  // of an edge

// The shortest edge at each node, m.
template <int Dim>
std::vector<double> edges_at_nodes(const ElasticMesh<Dim>& mesh) {
  std::vector<double> edge(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.element_count(); ++e) {
    const int* nodes = mesh.element(e);
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < elastic::edges_per_simplex(Dim); ++k) {
      const auto [a, b] = elastic::edge_corners[k];
      shortest = std::min(shortest, (mesh.nodes[nodes[a]] - mesh.nodes[nodes[b]]).norm());
    }
    for (int i = 0; i < mesh.nodes_per_element(); ++i) edge[nodes[i]] = std::min(edge[nodes[i]], shortest);
  }
  return edge;
}

template <int Dim>
Vec<Dim> gradient(const ShapeField<Dim>& phi, const Vec<Dim>& x, double step) {
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) {
    const Vec<Dim> ahead = step * Vec<Dim>::Unit(a);
    g[a] = (phi(x + ahead) - phi(x - ahead)) / (2 * step);
  }
  return g;
}

// Projects onto phi = 0 by Newton's method along the gradient: x <- x - phi g / |g|^2. Returns the start if it leads
// too far.
template <int Dim>
Vec<Dim> foot(const ShapeField<Dim>& phi, const Vec<Dim>& start, double edge) {
  Vec<Dim> x = start;
  for (int i = 0; i < 4; ++i) {
    const double d = phi(x);
    if (std::abs(d) < exact_enough * edge) break;
    const Vec<Dim> g = gradient(phi, x, difference * edge);
    if (!(g.squaredNorm() > 0.25)) return start;  // on a ridge: the nearest point is undefined
    x -= d / g.squaredNorm() * g;
  }
  return (x - start).norm() <= furthest * edge ? x : start;
}

template <int Dim>
std::vector<double> jacobians(const ElasticMesh<Dim>& mesh) {
  std::vector<double> r(std::size_t(mesh.element_count()));
  for (int e = 0; e < mesh.element_count(); ++e) r[std::size_t(e)] = least_jacobian(mesh, e);
  return r;
}

}  // namespace

template <int Dim>
void fit_to_shape(ElasticMesh<Dim>& mesh, const ShapeField<Dim>& phi) {
  const std::vector<Vec<Dim>> before = mesh.nodes;
  const std::vector<double> kept = jacobians(mesh), edge = edges_at_nodes(mesh);
  std::set<int> moved;
  for (const BoundaryFace& face : boundary_faces(mesh)) moved.insert(face.nodes.begin(), face.nodes.end());
  for (const int n : moved) mesh.nodes[n] = foot<Dim>(phi, before[n], edge[n]);
  // Each round restores nodes of at least one element, so there are no more rounds than elements.
  for (bool is_clean = false; !is_clean;) {
    is_clean = true;
    for (int e = 0; e < mesh.element_count(); ++e) {
      if (least_jacobian(mesh, e) >= least_kept * kept[std::size_t(e)]) continue;
      for (int i = 0; i < mesh.nodes_per_element(); ++i) {
        const int n = mesh.element(e)[i];
        if (mesh.nodes[n] == before[n]) continue;
        mesh.nodes[n] = before[n];
        is_clean = false;
      }
    }
  }
}

template void fit_to_shape<2>(ElasticMesh<2>&, const ShapeField<2>&);
template void fit_to_shape<3>(ElasticMesh<3>&, const ShapeField<3>&);

}  // namespace seiche
