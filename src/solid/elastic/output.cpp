#include "solid/elastic/output.h"

#include <Eigen/Dense>
#include <cmath>

namespace seiche {
namespace {

// F = 1 + sum u_a (dN_a/dX)^T at a quadrature point; F_33 = 1 in 2D.
template <int Dim>
Eigen::Matrix3d deformation_at(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, int element, int point) {
  const auto& gradients =
      body.gradients[std::size_t(element) * std::size_t(body.points_per_element) + std::size_t(point)];
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  const int* nodes = body.mesh.element(element);
  for (int a = 0; a < body.mesh.nodes_per_element(); ++a)
    F.topLeftCorner<Dim, Dim>() += u.segment<Dim>(Dim * nodes[a]) * gradients.row(a);
  return F;
}

double von_mises_of(const Eigen::Matrix3d& cauchy) {
  const Eigen::Matrix3d s = cauchy - cauchy.trace() / 3 * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5) * s.norm();
}

// A node on an edge gets the mean of the edge's corners.
template <int Dim>
void fill_between(const ElasticMesh<Dim>& mesh, std::vector<double>& values) {
  for (int e = 0; e < mesh.element_count() && mesh.order == 2; ++e) {
    const int* nodes = mesh.element(e);
    for (int k = 0; k < elastic::edges_per_simplex(Dim); ++k) {
      const auto [a, b] = elastic::edge_corners[std::size_t(k)];
      values[std::size_t(nodes[Dim + 1 + k])] = (values[std::size_t(nodes[a])] + values[std::size_t(nodes[b])]) / 2;
    }
  }
}

template <int Dim>
std::vector<Vec3> at_nodes(const Eigen::VectorXd& values) {
  std::vector<Vec3> r;
  for (Eigen::Index n = 0; n < values.size() / Dim; ++n)
    r.push_back(extend<Dim>(Vec<Dim>(values.segment<Dim>(Dim * n))));
  return r;
}

}  // namespace

template <int Dim>
std::vector<double> von_mises_stress(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  const ElasticMesh<Dim>& mesh = body.mesh;
  const ElasticMaterial<3>& material = elastic_material<3>(body.material.name);
  const auto points = elastic::quadrature(Dim, mesh.order);
  std::vector<double> sum(mesh.nodes.size(), 0), weight(mesh.nodes.size(), 0);
  for (int e = 0; e < mesh.element_count(); ++e) {
    for (int q = 0; q < body.points_per_element; ++q) {
      const Eigen::Matrix3d F = deformation_at(body, u, e, q);
      const Eigen::Matrix3d P = material.stress(body.properties.lame, F);
      const double stress = von_mises_of(P * F.transpose() / F.determinant());
      const Eigen::VectorXd lambda = elastic::shape_values(Dim, 1, points[std::size_t(q)].xi);
      for (int a = 0; a <= Dim; ++a) {
        const std::size_t node = std::size_t(mesh.element(e)[a]);
        const double w =
            body.weights[std::size_t(e) * std::size_t(body.points_per_element) + std::size_t(q)] * lambda[a];
        sum[node] += w * stress;
        weight[node] += w;
      }
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] = weight[n] > 0 ? sum[n] / weight[n] : 0;
  fill_between(mesh, sum);
  return sum;
}

template <int Dim>
VolumeFrame volume_frame(const ElasticBody<Dim>& body, const ElasticSurface& surface, const Eigen::VectorXd& u,
                         const Eigen::VectorXd& v) {
  VolumeFrame frame{Dim, body.mesh.order,    {},           at_nodes<Dim>(u), at_nodes<Dim>(v),
                    {},  body.mesh.elements, surface.nodes};
  for (const Vec<Dim>& X : body.mesh.nodes) frame.rest.push_back(extend<Dim>(X));
  frame.von_mises = von_mises_stress(body, u);
  return frame;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                  \
  template std::vector<double> von_mises_stress<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&);           \
  template VolumeFrame volume_frame<Dim>(const ElasticBody<Dim>&, const ElasticSurface&, const Eigen::VectorXd&, \
                                         const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
