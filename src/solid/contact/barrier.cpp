#include "solid/contact/barrier.h"

#include <Eigen/Geometry>
#include <cmath>

namespace seiche::contact {
namespace {

// Edge pairs whose squared sine is below this value are mollified: their energy is then smooth for parallel edges (Li
// et al. 2020).
constexpr double parallel_share = 1e-3;

// m(c) = (2 - c/eps) c/eps below eps, 1 above, with c = |u x v|^2. eps is proportional to |u|^2 |v|^2, taken at rest
// for deformable edges, so it is constant.
struct Mollifier {
  double value = 1, slope = 0, curvature = 0;
  Vec3 u, v, cross;
};

Mollifier mollify(const PairPoints<3>& x, double at_rest) {
  Mollifier m;
  m.u = x[1] - x[0];
  m.v = x[3] - x[2];
  m.cross = m.u.cross(m.v);
  const double c = m.cross.squaredNorm();
  const double eps = at_rest > 0 ? parallel_share * at_rest : parallel_share * m.u.squaredNorm() * m.v.squaredNorm();
  if (!(c < eps)) return m;
  m.value = (2 - c / eps) * c / eps;
  m.slope = (2 - 2 * c / eps) / eps;
  m.curvature = -2 / (eps * eps);
  return m;
}

template <int Dim>
using PointVector = Eigen::Matrix<double, 4 * Dim, 1>;  // the four points, stacked

// Derivatives of c by the four points. With J = d(u x v): grad c = 2 J'w and H = 2 J'J + 2 w . d2(u x v), w = u x v.
struct CrossDerivatives {
  PointVector<3> gradient;
  PairEnergy<3>::Hessian hessian;
};

CrossDerivatives cross_derivatives(const Mollifier& m) {
  Eigen::Matrix<double, 3, 6> J;
  J << -cross_matrix(m.v), cross_matrix(m.u);
  Eigen::Matrix<double, 6, 6> H = 2 * J.transpose() * J;
  H.topRightCorner<3, 3>() -= 2 * cross_matrix(m.cross);
  H.bottomLeftCorner<3, 3>() += 2 * cross_matrix(m.cross);
  Eigen::Matrix<double, 6, 12> edges = Eigen::Matrix<double, 6, 12>::Zero();  // maps the points to u and v
  for (int i = 0; i < 6; ++i) {
    edges(i, i < 3 ? i : i + 3) = -1;
    edges(i, i < 3 ? i + 3 : i + 6) = 1;
  }
  return {edges.transpose() * (2 * J.transpose() * m.cross), edges.transpose() * H * edges};
}

// Hessian of d = sqrt(2 D) from that of D = r.r/2, r = sum w_i x_i, with moving nearest points: W - C B^-1 C'. W = w w'
// x 1; B holds the derivatives of D by the parameters of the nearest points, C the mixed ones.
template <int Dim>
typename PairEnergy<Dim>::Hessian distance_hessian(const PairPoints<Dim>& x, const Separation<Dim>& apart,
                                                   const PointVector<Dim>& gradient) {
  const Vec<Dim> r = apart.distance * apart.normal;
  Eigen::Matrix<double, Dim, 2> R = Eigen::Matrix<double, Dim, 2>::Zero();
  Eigen::Matrix<double, 4 * Dim, 2> C;
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 4; ++i) R.col(k) += apart.change[k][i] * x[i];
    for (int i = 0; i < 4; ++i)
      C.template block<Dim, 1>(Dim * i, k) = apart.change[k][i] * r + apart.weight[i] * R.col(k);
  }
  Eigen::Matrix2d B = R.transpose() * R;
  for (int k = apart.freedoms; k < 2; ++k) B(k, k) = 1;
  for (int k = apart.freedoms; k < 2; ++k) C.col(k).setZero();
  typename PairEnergy<Dim>::Hessian H = -C * B.inverse() * C.transpose() - gradient * gradient.transpose();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int axis = 0; axis < Dim; ++axis) H(Dim * i + axis, Dim * j + axis) += apart.weight[i] * apart.weight[j];
  return H / apart.distance;
}

// Adds the terms with the mollifier's derivatives to the derivatives of m b.
void add_mollifier(PairEnergy<3>& e, const Mollifier& m, const Barrier& b, const PointVector<3>& distance) {
  const CrossDerivatives c = cross_derivatives(m);
  const PointVector<3> gradient = m.slope * c.gradient;
  Eigen::Map<PointVector<3>>(e.gradient.data()) += b.value * gradient;
  e.hessian += b.slope * (gradient * distance.transpose() + distance * gradient.transpose()) +
               b.value * (m.slope * c.hessian + m.curvature * c.gradient * c.gradient.transpose());
}

}  // namespace

Barrier barrier(double d, double reach, double kappa) {
  if (d >= reach) return {};
  const double l = std::log(d / reach), below = d - reach;
  return {-kappa * below * below * l, -kappa * (2 * below * l + below * below / d),
          -kappa * (2 * l + 4 * below / d - below * below / (d * d))};
}

double stiffness_for(double force, double reach) {
  return force / -barrier(0.5 * reach, reach, 1).slope;
}

template <int Dim>
PairEnergy<Dim> pair_energy(PairKind kind, const PairPoints<Dim>& x, const Separation<Dim>& apart, double reach,
                            double stiffness, double edges_at_rest) {
  PairEnergy<Dim> e;
  const Barrier b = barrier(apart.distance, reach, stiffness);
  Mollifier m;
  if constexpr (Dim == 3)
    if (kind == PairKind::edge_edge) m = mollify(x, edges_at_rest);
  PointVector<Dim> gradient;
  for (int i = 0; i < 4; ++i) gradient.template segment<Dim>(Dim * i) = apart.weight[i] * apart.normal;
  e.value = m.value * b.value;
  e.force = -m.value * b.slope;
  Eigen::Map<PointVector<Dim>>(e.gradient.data()) = m.value * b.slope * gradient;
  e.hessian = m.value * b.curvature * gradient * gradient.transpose();
  if (kind != PairKind::point_wall) e.hessian += m.value * b.slope * distance_hessian<Dim>(x, apart, gradient);
  if constexpr (Dim == 3)
    if (m.slope != 0) add_mollifier(e, m, b, gradient);
  return e;
}

template <int Dim>
double pair_value(PairKind kind, const PairPoints<Dim>& x, double distance, double reach, double stiffness,
                  double edges_at_rest) {
  double share = 1;
  if constexpr (Dim == 3)
    if (kind == PairKind::edge_edge) share = mollify(x, edges_at_rest).value;
  return share * barrier(distance, reach, stiffness).value;
}

template double pair_value<2>(PairKind, const PairPoints<2>&, double, double, double, double);
template double pair_value<3>(PairKind, const PairPoints<3>&, double, double, double, double);
template PairEnergy<2> pair_energy<2>(PairKind, const PairPoints<2>&, const Separation<2>&, double, double, double);
template PairEnergy<3> pair_energy<3>(PairKind, const PairPoints<3>&, const Separation<3>&, double, double, double);

}  // namespace seiche::contact
