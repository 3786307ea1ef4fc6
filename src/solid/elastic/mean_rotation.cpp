#include "solid/elastic/mean_rotation.h"

#include <Eigen/Geometry>

namespace seiche {
namespace {

template <int Dim>
Vec<Dim> mean_of(const Eigen::VectorXd& x) {
  return Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>>(x.data(), Dim, x.size() / Dim).rowwise().mean();
}

Eigen::Matrix2d spin_of(const Eigen::Matrix2d& inertia, const Eigen::Matrix2d& moment) {
  const double a = (moment(0, 1) - moment(1, 0)) / inertia.trace();
  return Eigen::Matrix2d{{0, -a}, {a, 0}};
}

Eigen::Matrix3d spin_of(const Eigen::Matrix3d& inertia, const Eigen::Matrix3d& moment) {
  const Eigen::Vector3d torque(moment(1, 2) - moment(2, 1), moment(2, 0) - moment(0, 2), moment(0, 1) - moment(1, 0));
  const Eigen::Matrix3d about = inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
  const Eigen::Vector3d a = about.ldlt().solve(torque);
  return Eigen::Matrix3d{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

Eigen::Matrix2d rotation_of(const Eigen::Matrix2d& spin) {
  return Eigen::Rotation2Dd(spin(1, 0)).toRotationMatrix();
}

Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& spin) {
  const Eigen::Vector3d a(spin(2, 1), spin(0, 2), spin(1, 0));
  if (a.norm() == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(a.norm(), a.normalized()).toRotationMatrix();
}

}  // namespace

template <int Dim>
MeanRotation<Dim>::MeanRotation(const Eigen::VectorXd& x, const Eigen::VectorXd& d)
    : center_(mean_of<Dim>(x)), shift_(mean_of<Dim>(d)) {
  Eigen::Matrix<double, Dim, Dim> inertia, moment;  // sum r r', sum r d'
  inertia.setZero(), moment.setZero();
  for (Eigen::Index n = 0; n < x.size() / Dim; ++n) {
    const Vec<Dim> r = x.template segment<Dim>(Dim * n) - center_;
    inertia += r * r.transpose();
    moment += r * d.template segment<Dim>(Dim * n).transpose();
  }
  spin_ = spin_of(inertia, moment);
}

template <int Dim>
double MeanRotation<Dim>::angle() const {
  return spin_.norm() / std::sqrt(2.0);
}

template <int Dim>
Eigen::VectorXd MeanRotation<Dim>::along_arc(const Eigen::VectorXd& x, const Eigen::VectorXd& d) const {
  const Eigen::Matrix<double, Dim, Dim> turned = rotation_of(spin_);
  Eigen::VectorXd arc(d.size());
  for (Eigen::Index n = 0; n < x.size() / Dim; ++n) {
    const Vec<Dim> r = x.template segment<Dim>(Dim * n) - center_,
                   q = d.template segment<Dim>(Dim * n) - shift_ - spin_ * r;
    arc.template segment<Dim>(Dim * n) = shift_ + turned * (r + q) - r;
  }
  return arc;
}

template class MeanRotation<2>;
template class MeanRotation<3>;

}  // namespace seiche
