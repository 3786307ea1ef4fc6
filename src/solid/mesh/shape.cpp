#include "solid/mesh/shape.h"

#include <Eigen/Dense>
#include <array>
#include <cassert>
#include <cmath>

#include "linalg/core/symmetric_eigen.h"

namespace seiche::elastic {
namespace {

// Barycentric coordinates lambda. Below: their gradients as rows.
ShapeValues barycentric(int dim, const ReferencePoint& xi) {
  ShapeValues lambda(dim + 1);
  lambda << 1 - xi.sum(), xi;
  return lambda;
}

ReferenceGradients barycentric_gradients(int dim) {
  ReferenceGradients g(dim + 1, dim);
  g << Eigen::RowVectorXd::Constant(dim, -1), Eigen::MatrixXd::Identity(dim, dim);
  return g;
}

double factorial(int n) {
  return n < 2 ? 1 : n * factorial(n - 1);
}

// dim + 1 points at the permutations of lambda = (b, a, ..., a), exact to degree 2:
// b = (1 + dim c)/(dim + 1), a = (1 - c)/(dim + 1) with c = 1/sqrt(dim + 2).
std::vector<QuadraturePoint> second_degree(int dim) {
  const double c = 1 / std::sqrt(dim + 2.), a = (1 - c) / (dim + 1), b = 1 - dim * a;
  std::vector<QuadraturePoint> r;
  for (int i = 0; i <= dim; ++i) {
    ReferencePoint xi = ReferencePoint::Constant(dim, a);
    if (i > 0) xi[i - 1] = b;
    r.push_back({xi, 1 / factorial(dim + 1)});
  }
  return r;
}

// Gauss-Legendre on [0, 1]: the nodes are eigenvalues of the Jacobi matrix (Golub, Welsch 1969).
std::vector<QuadraturePoint> gauss(int count) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(count, count);
  for (int k = 1; k < count; ++k) T(k, k - 1) = T(k - 1, k) = k / std::sqrt(4. * k * k - 1);
  const SymmetricEigen eigen = symmetric_eigen(T);
  std::vector<QuadraturePoint> r;
  for (int k = 0; k < count; ++k) {
    const double first = eigen.vectors(0, k);
    r.push_back({ReferencePoint::Constant(1, (eigen.values[k] + 1) / 2), first * first});
  }
  return r;
}

// Conical product: the simplex as a cone over one of a dimension less, xi = (s, (1 - s) eta), weight (1 - s)^(dim - 1).
std::vector<QuadraturePoint> conical(int dim, const std::vector<QuadraturePoint>& line) {
  if (dim == 1) return line;
  std::vector<QuadraturePoint> r;
  for (const auto& [s, weight] : line) {
    for (const auto& base : conical(dim - 1, line)) {
      ReferencePoint xi(dim);
      xi << s[0], (1 - s[0]) * base.xi;
      r.push_back({xi, weight * std::pow(1 - s[0], dim - 1) * base.weight});
    }
  }
  return r;
}

std::vector<QuadraturePoint> make_quadrature(int dim, int degree) {
  if (degree <= 1) return {{ReferencePoint::Constant(dim, 1. / (dim + 1)), 1 / factorial(dim)}};
  if (degree == 2) return second_degree(dim);
  return conical(
      dim, gauss((degree + dim + 1) / 2));  // n points are exact to degree 2n - 1, of which the cone takes dim - 1
}

}  // namespace

const std::vector<QuadraturePoint>& quadrature(int dim, int degree) {
  constexpr int most = 6;
  static const auto rules = [] {
    std::array<std::array<std::vector<QuadraturePoint>, most + 1>, 4> all;
    for (int d = 1; d <= 3; ++d)
      for (int n = 0; n <= most; ++n) all[std::size_t(d)][std::size_t(n)] = make_quadrature(d, n);
    return all;
  }();
  assert(1 <= dim && dim <= 3 && 0 <= degree && degree <= most);
  return rules[std::size_t(dim)][std::size_t(degree)];
}

ShapeValues shape_values(int dim, int order, const ReferencePoint& xi) {
  const ShapeValues lambda = barycentric(dim, xi);
  if (order == 1) return lambda;
  ShapeValues N(nodes_per_simplex(dim, 2));
  for (int a = 0; a <= dim; ++a) N[a] = lambda[a] * (2 * lambda[a] - 1);
  for (int e = 0; e < edges_per_simplex(dim); ++e) {
    N[dim + 1 + e] = 4 * lambda[edge_corners[e][0]] * lambda[edge_corners[e][1]];
  }
  return N;
}

ReferenceGradients shape_gradients(int dim, int order, const ReferencePoint& xi) {
  const ReferenceGradients g = barycentric_gradients(dim);
  if (order == 1) return g;
  const ShapeValues lambda = barycentric(dim, xi);
  ReferenceGradients dN(nodes_per_simplex(dim, 2), dim);
  for (int a = 0; a <= dim; ++a) dN.row(a) = (4 * lambda[a] - 1) * g.row(a);
  for (int e = 0; e < edges_per_simplex(dim); ++e) {
    const auto [a, b] = edge_corners[e];
    dN.row(dim + 1 + e) = 4 * (lambda[a] * g.row(b) + lambda[b] * g.row(a));
  }
  return dN;
}

std::vector<ReferencePoint> node_points(int dim, int order) {
  std::vector<ReferencePoint> r(1, ReferencePoint::Zero(dim));
  for (int i = 0; i < dim; ++i) r.push_back(ReferencePoint::Unit(dim, i));
  for (int e = 0; order == 2 && e < edges_per_simplex(dim); ++e) {
    r.push_back((r[edge_corners[e][0]] + r[edge_corners[e][1]]) / 2);
  }
  return r;
}

}  // namespace seiche::elastic
