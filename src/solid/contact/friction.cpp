#include "solid/contact/friction.h"

#include <algorithm>
#include <cmath>

namespace seiche::contact {

SlipLaw slip_law(double y, double eps) {
  if (y >= eps) return {y, 1 / y, 0};
  const double s = y / eps;
  return {eps * (s * s - s * s * s / 3 + 1. / 3), (2 - s) / eps, 2 * (1 - s) / eps};
}

double pair_friction(const std::optional<double>& a, const std::optional<double>& b) {
  if (a && b) return std::sqrt(*a * *b);
  return a.value_or(b.value_or(0));
}

template <>
Eigen::Matrix<double, 2, 1> tangents<2>(const Vec<2>& n) {
  return {-n[1], n[0]};
}

template <>
Eigen::Matrix<double, 3, 2> tangents<3>(const Vec<3>& n) {
  int axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix<double, 3, 2> t;
  t.col(0) = n.cross(Vec3::Unit(axis)).normalized();
  t.col(1) = n.cross(Vec3(t.col(0)));
  return t;
}

template <int Dim>
Eigen::Matrix<double, Dim - 1, 1> slip(const FrictionPoint<Dim>& at, const Velocities<Dim>& velocities) {
  const auto rigid = [&](int body, const Vec<Dim>& arm) -> Vec<Dim> {
    const auto& twist = velocities.twists[body];
    return twist.template head<Dim>() + turned<Dim>(twist.template tail<turn_size<Dim>>(), arm);
  };
  const auto nearest = [&](int begin, int end) {  // weights of the second side are negative
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (int i = begin; i < end; ++i) sum += at.weight[i] * velocities.points[at.pair.points[i]];
    return sum;
  };
  const int split = points_of_first(at.pair.kind);
  Vec<Dim> u = at.first_deforms ? nearest(0, split) : rigid(at.first, at.arm_first);
  if (at.second_deforms)
    u += nearest(split, points_of(at.pair.kind, Dim));
  else if (at.second >= 0)
    u -= rigid(at.second, at.arm_second);
  return at.tangent.transpose() * u;
}

template <int Dim>
SlipEnergy<Dim> slip_energy(const FrictionPoint<Dim>& at, const Eigen::Matrix<double, Dim - 1, 1>& u,
                            double creep_speed) {
  const double y = u.norm();
  const SlipLaw law = slip_law(y, creep_speed);
  SlipEnergy<Dim> e;
  e.value = at.bound * law.value;
  e.gradient = at.bound * law.over_speed * u;
  e.hessian = at.bound * law.over_speed * Eigen::Matrix<double, Dim - 1, Dim - 1>::Identity();
  if (y == 0) return e;
  const Eigen::Matrix<double, Dim - 1, Dim - 1> turned = at.direction * (u / y).transpose();
  e.hessian -= 0.5 * at.bound * law.over_speed * law.slowness_change(y) * (turned + turned.transpose());
  return e;
}

// w = (u + du - w eta' t.du)/eta
template <int Dim>
Eigen::Matrix<double, Dim - 1, 1> next_direction(const FrictionPoint<Dim>& at,
                                                 const Eigen::Matrix<double, Dim - 1, 1>& u,
                                                 const Eigen::Matrix<double, Dim - 1, 1>& du, double creep_speed) {
  const double y = u.norm();
  const SlipLaw law = slip_law(y, creep_speed);
  const double slower = y > 0 ? law.slowness_change(y) * u.dot(du) / y : 0;
  const Eigen::Matrix<double, Dim - 1, 1> w = law.over_speed * (u + du - slower * at.direction);
  return w / std::max(1.0, w.norm());
}

template Eigen::Matrix<double, 1, 1> slip<2>(const FrictionPoint<2>&, const Velocities<2>&);
template Eigen::Matrix<double, 2, 1> slip<3>(const FrictionPoint<3>&, const Velocities<3>&);
template Eigen::Matrix<double, 1, 1> next_direction<2>(const FrictionPoint<2>&, const Eigen::Matrix<double, 1, 1>&,
                                                       const Eigen::Matrix<double, 1, 1>&, double);
template Eigen::Matrix<double, 2, 1> next_direction<3>(const FrictionPoint<3>&, const Eigen::Matrix<double, 2, 1>&,
                                                       const Eigen::Matrix<double, 2, 1>&, double);
template SlipEnergy<2> slip_energy<2>(const FrictionPoint<2>&, const Eigen::Matrix<double, 1, 1>&, double);
template SlipEnergy<3> slip_energy<3>(const FrictionPoint<3>&, const Eigen::Matrix<double, 2, 1>&, double);

}  // namespace seiche::contact
