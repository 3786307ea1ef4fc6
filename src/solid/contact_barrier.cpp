#include "solid/contact_barrier.h"

#include <Eigen/Geometry>
#include <cmath>

namespace seiche::contact {
namespace {

// Edges whose squared sine is below this count less, so that the energy of parallel ones is smooth (Li et al. 2020).
constexpr double parallel_share = 1e-3;

// m(c) = (2 - c/eps) c/eps below eps, 1 above, of c = |u x v|^2.
struct Mollifier {
  double value = 1, slope = 0;
  Vec3 u, v;
};

Mollifier mollify(const PairPoints<3>& x) {
  Mollifier m;
  m.u = x[1] - x[0];
  m.v = x[3] - x[2];
  const double c = m.u.cross(m.v).squaredNorm(), eps = parallel_share * m.u.squaredNorm() * m.v.squaredNorm();
  if (!(c < eps)) return m;
  m.value = (2 - c / eps) * c / eps;
  m.slope = (2 - 2 * c / eps) / eps;
  return m;
}

// Adds b dm to the gradient and its Gauss-Newton curvature 2 m' b J'J, J the derivative of u x v. |u||v| of a rigid
// edge pair is constant, so that eps has no derivative.
void add_mollifier(PairEnergy<3>& e, const Mollifier& m, double b) {
  const Vec3 cross = m.u.cross(m.v);
  const Vec3 by_u = 2 * m.v.cross(cross), by_v = 2 * cross.cross(m.u);
  const double scale = m.slope * b;
  e.gradient.col(0) -= scale * by_u;
  e.gradient.col(1) += scale * by_u;
  e.gradient.col(2) -= scale * by_v;
  e.gradient.col(3) += scale * by_v;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row_u = m.v.cross(Vec3::Unit(axis)), row_v = Vec3::Unit(axis).cross(m.u);
    e.stiffness[e.ranks] = 2 * scale;
    e.direction[e.ranks] << -row_u, row_u, -row_v, row_v;
    ++e.ranks;
  }
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
                            double stiffness) {
  PairEnergy<Dim> e;
  const Barrier b = barrier(apart.distance, reach, stiffness);
  Mollifier m;
  if constexpr (Dim == 3)
    if (kind == PairKind::edge_edge) m = mollify(x);
  for (int i = 0; i < 4; ++i) e.direction[0].col(i) = apart.weight[i] * apart.normal;
  e.value = m.value * b.value;
  e.force = -m.value * b.slope;
  e.gradient = m.value * b.slope * e.direction[0];
  e.stiffness[0] = m.value * b.curvature;
  e.ranks = 1;
  if constexpr (Dim == 3)
    if (m.slope != 0) add_mollifier(e, m, b.value);
  return e;
}

template PairEnergy<2> pair_energy<2>(PairKind, const PairPoints<2>&, const Separation<2>&, double, double);
template PairEnergy<3> pair_energy<3>(PairKind, const PairPoints<3>&, const Separation<3>&, double, double);

}  // namespace seiche::contact
