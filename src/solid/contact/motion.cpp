#include "solid/contact/motion.h"

#include <algorithm>
#include <cmath>

namespace seiche {
namespace contact {
namespace {

// Rotation vector of R.
template <int Dim>
Turn<Dim> angle_of(const Eigen::Matrix3d& R) {
  if constexpr (Dim == 2) return Turn<2>(std::atan2(R(1, 0), R(0, 0)));
  const Eigen::AngleAxisd turn{Eigen::Quaterniond(R).normalized()};
  const Vec3 angle = turn.angle() * turn.axis();
  return angle.tail<turn_size<Dim>>();
}

}  // namespace

template <>
Square<2> rotation_by<2>(const Turn<2>& angle) {
  return Eigen::Rotation2Dd(angle[0]).toRotationMatrix();
}

template <>
Square<3> rotation_by<3>(const Turn<3>& angle) {
  const double size = angle.norm();
  return size > 0 ? Eigen::AngleAxisd(size, angle / size).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

template <>
Eigen::Matrix<double, 1, 1> left_jacobian<2>(const Turn<2>&) {
  return Eigen::Matrix<double, 1, 1>::Ones();
}

// J_l = 1 + (1 - cos a)/a^2 [a] + (a - sin a)/a^3 [a]^2. Below 1e-3 by its series; the next terms are below round-off.
template <>
Eigen::Matrix3d left_jacobian<3>(const Turn<3>& angle) {
  const double a = angle.norm(), a2 = a * a;
  const Eigen::Matrix3d cross = cross_matrix(angle);
  const double first = a < 1e-3 ? 0.5 - a2 / 24 : (1 - std::cos(a)) / a2;
  const double second = a < 1e-3 ? 1. / 6 - a2 / 120 : (a - std::sin(a)) / (a2 * a);
  return Eigen::Matrix3d::Identity() + first * cross + second * cross * cross;
}

namespace {

// Centroid of the volume within a closed surface, by the divergence theorem. Sheets, and surfaces without volume: the
// mean of its points.
template <int Dim>
Vec<Dim> center_of(const Surface<Dim>& surface, const Vec<Dim>* points) {
  Vec<Dim> mean = Vec<Dim>::Zero(), sum = Vec<Dim>::Zero();
  double volume = 0;
  for (size_t p = 0; p < surface.points.size(); ++p) mean += points[p] / surface.points.size();
  for (const Element<Dim>& element : surface.elements) {
    Square<Dim> corners;
    for (int i = 0; i < Dim; ++i) corners.col(i) = points[element[i]] - mean;
    const double part = corners.determinant();
    volume += part;
    sum += part * corners.rowwise().sum() / (Dim + 1);
  }
  return surface.closed && volume > 0 ? Vec<Dim>(mean + sum / volume) : mean;
}

template <int Dim>
void add_deformable(const typename ContactScene<Dim>::Data& scene, int b, const ContactMotion& motion,
                    Interval<Dim>& r) {
  const Surface<Dim>& surface = scene.surfaces[b];
  const int begin = scene.point_begin[b];
  for (size_t p = 0; p < surface.points.size(); ++p) {
    Vec<Dim> x = surface.points[p];
    if (motion.displacement.size() > 0)
      x += motion.displacement.template segment<Dim>(Dim * scene.node(b, begin + static_cast<int>(p)));
    r.arms.push_back(x);
  }
  r.centers.push_back(center_of<Dim>(surface, r.arms.data() + begin));
  r.radius.push_back(0);
  for (size_t p = begin; p < r.arms.size(); ++p) {
    r.arms[p] -= r.centers.back();
    r.radius.back() = std::max(r.radius.back(), r.arms[p].norm());
  }
}

}  // namespace

template <int Dim>
Interval<Dim> make_interval(const typename ContactScene<Dim>::Data& scene, const std::vector<ContactMotion>& motions,
                            double horizon) {
  Interval<Dim> r;
  r.horizon = horizon;
  r.prescribed.resize(motions.size());
  for (size_t b = 0; b < motions.size(); ++b) {
    r.prescribed[b].setZero();
    if (scene.deforms(static_cast<int>(b))) {
      add_deformable<Dim>(scene, static_cast<int>(b), motions[b], r);
      continue;
    }
    const Pose& start = motions[b].start;
    const Eigen::Matrix3d& R = start.rotation;
    r.centers.push_back(truncate<Dim>(start.pivot + start.displacement));
    r.radius.push_back(0);
    for (const Vec<Dim>& rest : scene.surfaces[b].points) {
      r.arms.push_back(truncate<Dim>(R * (extend<Dim>(rest) - start.pivot)));
      r.radius.back() = std::max(r.radius.back(), r.arms.back().norm());
    }
    if (scene.control[b] == BodyControl::free) continue;
    const Pose& end = motions[b].end;
    r.prescribed[b] << (truncate<Dim>(end.apply(start.pivot)) - r.centers[b]) / horizon,
        angle_of<Dim>(end.rotation * R.transpose()) / horizon;
  }
  return r;
}

template <int Dim>
Placement<Dim> place(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                     const Velocities<Dim>& velocities) {
  Placement<Dim> r{velocities, interval.centers, interval.arms};
  for (size_t b = 0; b < velocities.twists.size(); ++b) {
    const int begin = scene.point_begin[b], end = scene.point_begin[b + 1];
    if (scene.deforms(static_cast<int>(b))) {
      for (int p = begin; p < end; ++p)
        r.points[p] = r.centers[b] + interval.arms[p] + interval.horizon * velocities.points[p];
      continue;
    }
    r.centers[b] += interval.horizon * velocities.twists[b].template head<Dim>();
    const Square<Dim> R = rotation_by<Dim>(interval.horizon * velocities.twists[b].template tail<turn_size<Dim>>());
    for (int p = begin; p < end; ++p) r.points[p] = r.centers[b] + R * interval.arms[p];
  }
  return r;
}

template <int Dim>
double fastest(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval, const Eigen::VectorXd& v) {
  double speed = 0;
  for (size_t b = 0; b < scene.surfaces.size(); ++b) {
    const int first = scene.first_dof[b];
    if (scene.control[b] == BodyControl::free) {
      const auto twist = v.template segment<twist_size<Dim>>(first);
      speed = std::max(
          speed, twist.template head<Dim>().norm() + interval.radius[b] * twist.template tail<turn_size<Dim>>().norm());
    }
    for (int n = 0; n < scene.node_count[b]; ++n)
      speed = std::max(speed, v.template segment<Dim>(first + Dim * n).norm());
  }
  return speed;
}

template <int Dim>
Velocities<Dim> all_velocities(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                               const Eigen::VectorXd& v, double share) {
  Velocities<Dim> r;
  r.twists.resize(interval.prescribed.size());
  for (size_t b = 0; b < r.twists.size(); ++b) {
    r.twists[b] = share * interval.prescribed[b];
    if (scene.control[b] == BodyControl::free) r.twists[b] = v.template segment<twist_size<Dim>>(scene.first_dof[b]);
  }
  if (!scene.any_deforms()) return r;
  r.points.assign(interval.arms.size(), Vec<Dim>::Zero());
  for (size_t p = 0; p < r.points.size(); ++p)
    if (scene.point_dof[p] >= 0) r.points[p] = v.template segment<Dim>(scene.point_dof[p]);
  return r;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                     \
  template Interval<Dim> make_interval<Dim>(const ContactScene<Dim>::Data&, const std::vector<ContactMotion>&,      \
                                            double);                                                                \
  template Placement<Dim> place<Dim>(const ContactScene<Dim>::Data&, const Interval<Dim>&, const Velocities<Dim>&); \
  template double fastest<Dim>(const ContactScene<Dim>::Data&, const Interval<Dim>&, const Eigen::VectorXd&);       \
  template Velocities<Dim> all_velocities<Dim>(const ContactScene<Dim>::Data&, const Interval<Dim>&,                \
                                               const Eigen::VectorXd&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace contact

template <int Dim>
Pose moved_pose(const Pose& start, const Eigen::Matrix<double, twist_size<Dim>, 1>& twist, double horizon) {
  Pose r = start;
  r.displacement += horizon * extend<Dim>(twist.template head<Dim>());
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<Dim, Dim>() = contact::rotation_by<Dim>(horizon * twist.template tail<contact::turn_size<Dim>>());
  // Renormalise, so that round-off does not accumulate over many intervals.
  r.rotation = Eigen::Quaterniond(turn * start.rotation).normalized().toRotationMatrix();
  return r;
}

template Pose moved_pose<2>(const Pose&, const Eigen::Matrix<double, 3, 1>&, double);
template Pose moved_pose<3>(const Pose&, const Eigen::Matrix<double, 6, 1>&, double);

}  // namespace seiche
