#include "coupling/solids/pressure_around.h"

#include <Eigen/QR>

#include "coupling/solids/face_columns.h"

namespace seiche {
namespace {

// p_0 and b about the given point.
template <int Dim>
using Affine = Eigen::Matrix<double, Dim + 1, 1>;
template <int Dim>
using Normal = Eigen::Matrix<double, Dim + 1, Dim + 1>;

template <int Dim>
Affine<Dim> basis_at(const Vec<Dim>& arm) {
  Affine<Dim> f;
  f << 1, arm;
  return f;
}

// Normal equations of the fit, N a = r, over all ranks. Collective.
template <int Dim>
std::pair<Normal<Dim>, Affine<Dim>> normal_equations(const Domain<Dim>& domain, const FaceShares& shares,
                                                     const PressureRows<Dim>& rows, const CellField<Dim>& pressure,
                                                     const Vec<Dim>& about) {
  constexpr int size = (Dim + 1) * (Dim + 2);
  Eigen::Matrix<double, Dim + 1, Dim + 2> sums = Eigen::Matrix<double, Dim + 1, Dim + 2>::Zero();
  for_each_cell_of_shares(domain, shares, with_row(rows), [&](Site cell, double, std::size_t n) {
    const Vec<Dim> x = domain.layout.position(domain.layout.index(cell), cell_offset<Dim>());
    const Affine<Dim> f = basis_at<Dim>((x - about) / domain.layout.h());
    sums.template leftCols<Dim + 1>() += shares[n].closed * f * f.transpose();
    sums.col(Dim + 1) += shares[n].closed * pressure[cell] * f;
  });
  std::array<double, size> flat;
  std::copy(sums.data(), sums.data() + size, flat.begin());
  domain.ranks.global_sum(flat);
  std::copy(flat.begin(), flat.end(), sums.data());
  return {sums.template leftCols<Dim + 1>(), sums.col(Dim + 1)};
}

// Middle of an element's corners.
template <int Dim>
Vec<Dim> middle_of(const ElasticBody<Dim>& body, int element, const Eigen::VectorXd& u) {
  Vec<Dim> x = Vec<Dim>::Zero();
  for (int k = 0; k <= Dim; ++k) {
    const int node = body.mesh.element(element)[k];
    x += (body.mesh.nodes[std::size_t(node)] + u.segment<Dim>(Dim * Eigen::Index(node))) / (Dim + 1);
  }
  return x;
}

}  // namespace

template <int Dim>
std::vector<double> pressure_around(const Domain<Dim>& domain, const FaceShares& shares, const PressureRows<Dim>& rows,
                                    const CellField<Dim>& pressure, const ElasticBody<Dim>& body,
                                    const Eigen::VectorXd& u) {
  const Vec<Dim> about = middle_of(body, 0, u);
  const auto [N, r] = normal_equations(domain, shares, rows, pressure, about);
  if (N(0, 0) == 0) return {};
  const Affine<Dim> a = N.completeOrthogonalDecomposition().solve(r);  // of least size where cells lie in one plane
  std::vector<double> p;
  for (int e = 0; e < body.mesh.element_count(); ++e)
    p.resize(p.size() + std::size_t(body.points_per_element),
             a.dot(basis_at<Dim>((middle_of(body, e, u) - about) / domain.layout.h())));
  return p;
}

#define SEICHE_INSTANTIATE(D)                                                                                  \
  template std::vector<double> pressure_around<D>(const Domain<D>&, const FaceShares&, const PressureRows<D>&, \
                                                  const CellField<D>&, const ElasticBody<D>&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
