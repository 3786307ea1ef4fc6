#include "solid/elastic/body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

namespace seiche {
namespace {

using elastic::QuadraturePoint;
using elastic::ReferencePoint;

constexpr int load_degree = 5;  // of the quadrature for masses and loads; masses of straight quadratic elements need 4

// dX/dxi and shape gradients dN/dX = dN/dxi (dX/dxi)^-1 at a point of an element.
template <int Dim>
struct Map {
  Eigen::Matrix<double, Dim, Dim> jacobian;
  ShapeGradients<Dim> gradients;
};

template <int Dim>
Map<Dim> map_at(const ElasticMesh<Dim>& mesh, int e, const Eigen::MatrixXd& reference_gradients) {
  Map<Dim> r;
  r.jacobian.setZero();
  for (int a = 0; a < reference_gradients.rows(); ++a) {
    r.jacobian += mesh.nodes[mesh.element(e)[a]] * reference_gradients.row(a);
  }
  r.gradients = reference_gradients * r.jacobian.inverse();
  return r;
}

template <int Dim>
void tabulate_gradients(ElasticBody<Dim>& body) {
  const int order = body.mesh.order;
  const auto rule = elastic::quadrature(Dim, order);
  const auto nodes = elastic::node_points(Dim, order);
  body.points_per_element = int(rule.size());
  for (int e = 0; e < body.mesh.element_count(); ++e) {
    for (const auto& [xi, weight] : rule) {
      const Map<Dim> map = map_at(body.mesh, e, elastic::shape_gradients(Dim, order, xi));
      body.gradients.push_back(map.gradients);
      body.weights.push_back(weight * map.jacobian.determinant());
    }
    for (size_t a = 0; order == 2 && a < nodes.size(); ++a) {
      body.node_gradients.push_back(map_at(body.mesh, e, elastic::shape_gradients(Dim, order, nodes[a])).gradients);
    }
  }
}

// Sparsity pattern: zero blocks for all pairs of nodes that share an element, and each element's positions in it.
template <int Dim>
void make_pattern(ElasticBody<Dim>& body) {
  const int count = body.mesh.nodes_per_element();
  std::vector<std::vector<int>> neighbours(body.mesh.nodes.size());
  for (int e = 0; e < body.mesh.element_count(); ++e) {
    const int* n = body.mesh.element(e);
    for (int a = 0; a < count; ++a) neighbours[n[a]].insert(neighbours[n[a]].end(), n, n + count);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t b = 0; b < neighbours.size(); ++b) {
    auto& list = neighbours[b];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    for (int k = 0; k < Dim; ++k) {
      for (int row = 0; row < Dim * int(list.size()); ++row) {
        entries.emplace_back(Dim * list[row / Dim] + row % Dim, Dim * int(b) + k, 0);
      }
    }
  }
  body.pattern.resize(body.size(), body.size());
  body.pattern.setFromTriplets(entries.begin(), entries.end());
  for (int e = 0; e < body.mesh.element_count(); ++e) {
    const int* n = body.mesh.element(e);
    for (int a = 0; a < count * count; ++a) {
      const auto& list = neighbours[n[a % count]];
      body.slots.push_back(Dim * int(std::lower_bound(list.begin(), list.end(), n[a / count]) - list.begin()));
    }
  }
}

// Visits f(element, shape values, point X, volume of the point) over the quadrature for masses and loads.
template <int Dim, class Visit>
void over_volume(const ElasticMesh<Dim>& mesh, Visit visit) {
  for (const auto& [xi, weight] : elastic::quadrature(Dim, load_degree)) {
    const Eigen::VectorXd N = elastic::shape_values(Dim, mesh.order, xi);
    const Eigen::MatrixXd dN = elastic::shape_gradients(Dim, mesh.order, xi);
    for (int e = 0; e < mesh.element_count(); ++e) {
      Vec<Dim> X = Vec<Dim>::Zero();
      for (int a = 0; a < N.size(); ++a) X += N[a] * mesh.nodes[mesh.element(e)[a]];
      visit(e, N, X, weight * map_at(mesh, e, dN).jacobian.determinant());
    }
  }
}

// M_ab = integral of rho N_a N_b. Lumped: its diagonal, scaled to the body's mass.
template <int Dim>
void assemble_mass(ElasticBody<Dim>& body) {
  body.mass = body.pattern;
  const int count = body.mesh.nodes_per_element();
  const auto add = [&](int e, const Eigen::VectorXd& N, const Vec<Dim>&, double volume) {
    const int* n = body.mesh.element(e);
    const int* slot = &body.slots[size_t(e) * count * count];
    for (int a = 0; a < count; ++a) {
      const double row = body.properties.density * volume * N[a];
      for (int b = 0; b < count; ++b, ++slot)
        for (int k = 0; k < Dim; ++k)
          body.mass.valuePtr()[body.mass.outerIndexPtr()[Dim * n[b] + k] + *slot + k] += row * N[b];
    }
  };
  over_volume(body.mesh, add);
  body.lumped_mass = body.mass.diagonal();
  body.lumped_mass *= body.mass.sum() / body.lumped_mass.sum();
}

}  // namespace

template <int Dim>
ElasticBody<Dim> make_elastic_body(ElasticMesh<Dim> mesh, const ElasticMaterial<Dim>& material,
                                   const ElasticProperties& properties) {
  ElasticBody<Dim> body;
  body.mesh = std::move(mesh);
  body.material = material;
  body.properties = properties;
  tabulate_gradients(body);
  make_pattern(body);
  assemble_mass(body);
  return body;
}

template <int Dim>
Eigen::VectorXd body_force(const ElasticBody<Dim>& body, const std::function<Vec<Dim>(const Vec<Dim>&)>& f) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(body.size());
  over_volume(body.mesh, [&](int e, const Eigen::VectorXd& N, const Vec<Dim>& X, double volume) {
    const Vec<Dim> load = volume * f(X);
    for (int a = 0; a < N.size(); ++a) r.segment<Dim>(Dim * body.mesh.element(e)[a]) += N[a] * load;
  });
  return r;
}

template <int Dim>
Eigen::VectorXd traction_force(const ElasticBody<Dim>& body, const std::vector<BoundaryFace>& faces,
                               const std::function<Vec<Dim>(const Vec<Dim>&)>& t) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(body.size());
  for (const auto& [xi, weight] : elastic::quadrature(Dim - 1, load_degree)) {
    const Eigen::VectorXd N = elastic::shape_values(Dim - 1, body.mesh.order, xi);
    const Eigen::MatrixXd dN = elastic::shape_gradients(Dim - 1, body.mesh.order, xi);
    for (const BoundaryFace& face : faces) {
      Vec<Dim> X = Vec<Dim>::Zero();
      Eigen::Matrix<double, Dim, Dim - 1> tangents = Eigen::Matrix<double, Dim, Dim - 1>::Zero();
      for (int a = 0; a < N.size(); ++a) {
        X += N[a] * body.mesh.nodes[face.nodes[a]];
        tangents += body.mesh.nodes[face.nodes[a]] * dN.row(a);
      }
      const double area = std::sqrt((tangents.transpose() * tangents).determinant());
      const Vec<Dim> load = weight * area * t(X);
      for (int a = 0; a < N.size(); ++a) r.segment<Dim>(Dim * face.nodes[a]) += N[a] * load;
    }
  }
  return r;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                       \
  template ElasticBody<Dim> make_elastic_body<Dim>(ElasticMesh<Dim>, const ElasticMaterial<Dim>&,                     \
                                                   const ElasticProperties&);                                         \
  template Eigen::VectorXd body_force<Dim>(const ElasticBody<Dim>&, const std::function<Vec<Dim>(const Vec<Dim>&)>&); \
  template Eigen::VectorXd traction_force<Dim>(const ElasticBody<Dim>&, const std::vector<BoundaryFace>&,             \
                                               const std::function<Vec<Dim>(const Vec<Dim>&)>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
