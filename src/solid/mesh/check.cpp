#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "base/error.h"
#include "solid/mesh/mesh.h"

namespace seiche {
namespace {

constexpr int listed = 5;             // ids in a message
constexpr double flat_below = 1e-12;  // of the longest edge to the power Dim: round-off of coordinates of that size

[[noreturn]] void fail(const std::string& where, const std::string& what, const std::vector<int>& ids) {
  std::string text = where + ": " + std::to_string(ids.size()) + " " + what + ":";
  for (int i = 0; i < std::min(listed, int(ids.size())); ++i) text += " " + std::to_string(ids[i]);
  throw Error(ExitCode::bad_input, text + (ids.size() > listed ? " ..." : "") + " (counted from 0)");
}

void fail_if_any(const std::string& where, const std::string& what, const std::vector<int>& ids) {
  if (!ids.empty()) fail(where, what, ids);
}

template <int Dim, class Predicate>
std::vector<int> elements_where(const ElasticMesh<Dim>& mesh, Predicate wrong) {
  std::vector<int> ids;
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (wrong(e)) ids.push_back(e);
  }
  return ids;
}

template <int Dim>
void check_indices(const ElasticMesh<Dim>& mesh, const std::string& where) {
  const int count = mesh.nodes_per_element();
  if (mesh.elements.empty() || mesh.elements.size() % count != 0) {
    throw Error(ExitCode::bad_input, where + ": no elements, or an element without all of its nodes");
  }
  fail_if_any(where, "elements have a node that does not exist", elements_where(mesh, [&](int e) {
                const int* n = mesh.element(e);
                return std::any_of(n, n + count, [&](int i) { return i < 0 || i >= int(mesh.nodes.size()); });
              }));
  fail_if_any(where, "elements have a node twice", elements_where(mesh, [&](int e) {
                return int(std::set<int>(mesh.element(e), mesh.element(e) + count).size()) < count;
              }));
}

template <int Dim>
void drop_unused(ElasticMesh<Dim>& mesh, const std::string& where, std::vector<std::string>& notes) {
  std::vector<int> place(mesh.nodes.size(), -1);
  for (int n : mesh.elements) place[n] = 0;
  std::vector<Vec<Dim>> kept;
  for (size_t n = 0; n < place.size(); ++n) {
    if (place[n] < 0) continue;
    place[n] = int(kept.size());
    kept.push_back(mesh.nodes[n]);
  }
  if (kept.size() == mesh.nodes.size()) return;
  notes.push_back(where + ": dropped " + std::to_string(mesh.nodes.size() - kept.size()) +
                  " nodes that belong to no element");
  for (int& n : mesh.elements) n = place[n];
  mesh.nodes = std::move(kept);
}

template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> element_nodes(const ElasticMesh<Dim>& mesh, int e) {
  Eigen::Matrix<double, Dim, Eigen::Dynamic> X(Dim, mesh.nodes_per_element());
  for (int a = 0; a < X.cols(); ++a) X.col(a) = mesh.nodes[mesh.element(e)[a]];
  return X;
}

template <int Dim>
double longest_edge(const ElasticMesh<Dim>& mesh, int e) {
  double r = 0;
  for (int k = 0; k < elastic::edges_per_simplex(Dim); ++k) {
    const auto [a, b] = elastic::edge_corners[k];
    r = std::max(r, (mesh.nodes[mesh.element(e)[a]] - mesh.nodes[mesh.element(e)[b]]).norm());
  }
  return r;
}

// Elements not connected to the first one by shared corners.
template <int Dim>
std::vector<int> apart(const ElasticMesh<Dim>& mesh) {
  std::vector<int> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  for (int e = 0; e < mesh.element_count(); ++e) {
    for (int a = 1; a <= Dim; ++a) root[find(mesh.element(e)[a])] = find(mesh.element(e)[0]);
  }
  return elements_where(mesh, [&](int e) { return find(mesh.element(e)[0]) != find(mesh.element(0)[0]); });
}

// Mean ratio: Dim det(A)^(2/Dim) / |A|^2, A the map from the regular simplex.
template <int Dim>
double mean_ratio(const Eigen::Matrix<double, Dim, Dim>& edges) {
  const Eigen::Matrix3d regular{{1, 0.5, 0.5}, {0, std::sqrt(3. / 4), std::sqrt(1. / 12)}, {0, 0, std::sqrt(2. / 3)}};
  const Eigen::Matrix<double, Dim, Dim> A = edges * regular.topLeftCorner<Dim, Dim>().inverse();
  return Dim * std::pow(std::max(A.determinant(), 0.), 2. / Dim) / A.squaredNorm();
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> corner_edges(const ElasticMesh<Dim>& mesh, int e) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int a = 0; a < Dim; ++a) edges.col(a) = mesh.nodes[mesh.element(e)[a + 1]] - mesh.nodes[mesh.element(e)[0]];
  return edges;
}

}  // namespace

template <int Dim>
double least_jacobian(const ElasticMesh<Dim>& mesh, int element) {
  const auto X = element_nodes(mesh, element);
  auto points = elastic::node_points(Dim, mesh.order);
  for (const auto& q : elastic::quadrature(Dim, mesh.order)) points.push_back(q.xi);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& xi : points) {
    const Eigen::Matrix<double, Dim, Dim> map = X * elastic::shape_gradients(Dim, mesh.order, xi);
    least = std::min(least, map.determinant());
  }
  return least / std::pow(longest_edge(mesh, element), Dim);
}

template <int Dim>
void check_mesh(ElasticMesh<Dim>& mesh, const std::string& where, std::vector<std::string>& notes) {
  std::vector<int> wild;
  for (size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (!mesh.nodes[n].allFinite()) wild.push_back(int(n));
  }
  fail_if_any(where, "nodes are not finite", wild);
  check_indices(mesh, where);
  std::vector<double> jacobian(mesh.element_count());
  for (int e = 0; e < mesh.element_count(); ++e) jacobian[e] = least_jacobian(mesh, e);
  fail_if_any(where, "elements are inverted", elements_where(mesh, [&](int e) { return jacobian[e] < -flat_below; }));
  fail_if_any(where, "elements have no volume",
              elements_where(mesh, [&](int e) { return !(jacobian[e] > flat_below); }));
  fail_if_any(where, "elements do not hang together with element 0", apart(mesh));
  drop_unused(mesh, where, notes);
}

template <int Dim>
MeshQuality mesh_quality(const ElasticMesh<Dim>& mesh) {
  MeshQuality q{int(mesh.nodes.size()), mesh.element_count(), 0, std::numeric_limits<double>::infinity(), 0, 1, 0, 0};
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto edges = corner_edges(mesh, e);
    const double ratio = mean_ratio<Dim>(edges);
    if (ratio < q.worst) q.worst_element = e;
    q.worst = std::min(q.worst, ratio);
    q.mean += ratio / q.elements;
    q.volume += edges.determinant() / (Dim == 2 ? 2 : 6);
    for (int k = 0; k < elastic::edges_per_simplex(Dim); ++k) {
      const auto [a, b] = elastic::edge_corners[k];
      const double length = (mesh.nodes[mesh.element(e)[a]] - mesh.nodes[mesh.element(e)[b]]).norm();
      q.shortest_edge = std::min(q.shortest_edge, length);
      q.longest_edge = std::max(q.longest_edge, length);
    }
  }
  return q;
}

template void check_mesh<2>(ElasticMesh<2>&, const std::string&, std::vector<std::string>&);
template void check_mesh<3>(ElasticMesh<3>&, const std::string&, std::vector<std::string>&);
template double least_jacobian<2>(const ElasticMesh<2>&, int);
template double least_jacobian<3>(const ElasticMesh<3>&, int);
template MeshQuality mesh_quality<2>(const ElasticMesh<2>&);
template MeshQuality mesh_quality<3>(const ElasticMesh<3>&);

}  // namespace seiche
