#include "solid/elastic/side_loads.h"

#include <Eigen/Geometry>

namespace seiche {
namespace {

using elastic::ReferencePoint;

// Corners of a simplex in the reference coordinates of an element's side.
using ReferenceSimplex = std::vector<ReferencePoint>;

// Outline of a piece as simplices on its side: the segment itself in 2D, a fan of triangles in 3D.
template <int Dim>
std::vector<ReferenceSimplex> simplices_of(const FacetPiece<Dim>& piece, int order) {
  const std::vector<std::vector<int>> facets = facets_of_side(Dim, order);
  const std::vector<int>& corners = facets[std::size_t(piece.facet) % facets.size()];
  const std::vector<ReferencePoint> nodes = elastic::node_points(Dim - 1, order);
  ReferenceSimplex outline;
  for (const FacetWeights<Dim>& w : piece.outline) {
    ReferencePoint xi = ReferencePoint::Zero(Dim - 1);
    for (int i = 0; i < Dim; ++i) xi += w[i] * nodes[std::size_t(corners[std::size_t(i)])];
    outline.push_back(xi);
  }
  if constexpr (Dim == 2) return {outline};
  std::vector<ReferenceSimplex> fan;
  for (std::size_t n = 1; n + 1 < outline.size(); ++n) fan.push_back({outline[0], outline[n], outline[n + 1]});
  return fan;
}

// Length (2D) or twice the area (3D) in reference coordinates.
double reference_size(const ReferenceSimplex& s) {
  if (s.size() == 2) return std::abs(s[1][0] - s[0][0]);
  const ReferencePoint a = s[1] - s[0], b = s[2] - s[0];
  return std::abs(a[0] * b[1] - a[1] * b[0]);
}

// n dA per d xi, from dx/dxi. The inside lies left of a side in 2D; in 3D sides are counter-clockwise seen from
// outside.
Vec<2> area_per_reference(const Eigen::Matrix<double, 2, 1>& t) {
  return {t[1], -t[0]};
}
Vec<3> area_per_reference(const Eigen::Matrix<double, 3, 2>& t) {
  return t.col(0).cross(t.col(1));
}

}  // namespace

template <int Dim>
SideLoad<Dim> load_of_piece(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const FacetPiece<Dim>& piece) {
  const ElasticMesh<Dim>& mesh = solid.body.mesh;
  const std::size_t facets = facets_of_side(Dim, mesh.order).size();
  SideLoad<Dim> load{solid.surface.sides[std::size_t(piece.facet) / facets].nodes, {}, {}};
  const auto count = Eigen::Index(load.nodes.size());
  load.area.setZero(Dim, count);
  load.moment.assign(load.nodes.size(), Eigen::Matrix<double, Dim, Dim>::Zero());
  Eigen::Matrix<double, Dim, Eigen::Dynamic> x(Dim, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int n = load.nodes[std::size_t(i)];
    x.col(i) = mesh.nodes[std::size_t(n)] + u.segment<Dim>(Dim * n);
  }
  // N_i n has degree 1; on quadratic sides 3 in 2D and 4 in 3D. The factor x adds one or two.
  for (const ReferenceSimplex& simplex : simplices_of(piece, mesh.order))
    for (const elastic::QuadraturePoint& q : elastic::quadrature(Dim - 1, mesh.order == 1 ? 2 : 5)) {
      ReferencePoint xi = (1 - q.xi.sum()) * simplex[0];
      for (int i = 1; i < Dim; ++i) xi += q.xi[i - 1] * simplex[std::size_t(i)];
      const Eigen::VectorXd N = elastic::shape_values(Dim - 1, mesh.order, xi);
      const Eigen::Matrix<double, Dim, Dim - 1> slope = x * elastic::shape_gradients(Dim - 1, mesh.order, xi);
      const Vec<Dim> area = q.weight * reference_size(simplex) * area_per_reference(slope), at = x * N;
      for (Eigen::Index i = 0; i < count; ++i) {
        load.area.col(i) += N[i] * area;
        load.moment[std::size_t(i)] += N[i] * area * at.transpose();
      }
    }
  return load;
}

template SideLoad<2> load_of_piece<2>(const ElasticSolid<2>&, const Eigen::VectorXd&, const FacetPiece<2>&);
template SideLoad<3> load_of_piece<3>(const ElasticSolid<3>&, const Eigen::VectorXd&, const FacetPiece<3>&);

}  // namespace seiche
