#pragma once
// Shape functions and quadrature on the reference simplex: lambda_0 = 1 - sum xi, lambda_i = xi_i.
#include <array>
#include <vector>

#include "base/vec.h"

namespace seiche::elastic {

// Nodes of a simplex of dimension `dim`: corners, and at order 2 also edge middles.
constexpr int nodes_per_simplex(int dim, int order) {
  return order == 1 ? dim + 1 : (dim + 1) * (dim + 2) / 2;
}

// Corners of the edge with node dim + 1 + i of a quadratic simplex, in VTK's order.
constexpr std::array<std::array<int, 2>, 6> edge_corners{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
// A segment has one edge, a triangle three, a tetrahedron six.
constexpr int edges_per_simplex(int dim) {
  return dim * (dim + 1) / 2;
}

using ReferencePoint = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;  // xi, `dim` numbers
// Values at the nodes of a simplex, at most ten.
using ShapeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 10, 1>;
using ReferenceGradients = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 10, 3>;

struct QuadraturePoint {
  ReferencePoint xi;
  double weight;  // of a simplex of volume 1/dim!
};

// Quadrature exact for polynomials of this degree, at most 6. Degrees 1 and 2 use the fewest points, higher ones the
// conical product (Stroud).
const std::vector<QuadraturePoint>& quadrature(int dim, int degree);

// N_a(xi): lambda_a, or lambda_a (2 lambda_a - 1) at corners and 4 lambda_a lambda_b on edges.
ShapeValues shape_values(int dim, int order, const ReferencePoint& xi);
// Row a is dN_a / dxi.
ReferenceGradients shape_gradients(int dim, int order, const ReferencePoint& xi);
// Reference coordinates of the nodes.
std::vector<ReferencePoint> node_points(int dim, int order);

}  // namespace seiche::elastic
