#pragma once
// Positions of all bodies' points after moving with given velocities.
#include <Eigen/Dense>

#include "solid/contact/surface.h"

namespace seiche::contact {

template <int Dim>
using Square = Eigen::Matrix<double, Dim, Dim>;
template <int Dim>
using Twists = std::vector<Eigen::Matrix<double, twist_size<Dim>, 1>>;  // one a body
template <int Dim>
constexpr int turn_size = twist_size<Dim> - Dim;
template <int Dim>
using Turn = Eigen::Matrix<double, turn_size<Dim>, 1>;  // angular velocity, rotation vector or torque

// Exponential map of a rotation vector and its left Jacobian: exp([a + da]) = exp([J_l da]) exp([a]) to first order.
template <int Dim>
Square<Dim> rotation_by(const Turn<Dim>& angle);
template <int Dim>
Eigen::Matrix<double, turn_size<Dim>, turn_size<Dim>> left_jacobian(const Turn<Dim>& angle);

// omega x r and r x f.
template <int Dim>
Vec<Dim> turned(const Turn<Dim>& omega, const Vec<Dim>& arm) {
  if constexpr (Dim == 2)
    return {-omega[0] * arm[1], omega[0] * arm[0]};
  else
    return omega.cross(arm);
}
template <int Dim>
Turn<Dim> moment(const Vec<Dim>& arm, const Vec<Dim>& force) {
  if constexpr (Dim == 2)
    return Turn<2>(arm[0] * force[1] - arm[1] * force[0]);
  else
    return arm.cross(force);
}

// Velocities of all bodies.
template <int Dim>
struct Velocities {
  Twists<Dim> twists;            // of rigid bodies; zero for deformable ones
  std::vector<Vec<Dim>> points;  // of all points; zero on rigid bodies, empty if all bodies are rigid
};

// One interval: initial positions, and the velocities that take prescribed bodies to their end poses.
template <int Dim>
struct Interval {
  double horizon = 0;             // s
  std::vector<Vec<Dim>> centers;  // of each body at the start; for deformable bodies the centroid of the volume
  std::vector<Vec<Dim>> arms;     // initial vectors from each body's centre to its points
  std::vector<double> radius;     // of each body: its longest arm
  Twists<Dim> prescribed;         // zero for others
};

template <int Dim>
Interval<Dim> make_interval(const typename ContactScene<Dim>::Data& scene, const std::vector<ContactMotion>& motions,
                            double horizon);

// Positions x = c + H v + exp(H omega) r; for deformable bodies x = c + r + H v with the point's velocity v.
template <int Dim>
struct Placement {
  Velocities<Dim> velocities;
  std::vector<Vec<Dim>> centers, points;
};

template <int Dim>
Placement<Dim> place(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                     const Velocities<Dim>& velocities);

// Largest speed (m/s) of a point of a rigid body or a node of a deformable body at the stacked v.
template <int Dim>
double fastest(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval, const Eigen::VectorXd& v);

// Velocities of all bodies: prescribed ones scaled by `share`, others from the stacked v.
template <int Dim>
Velocities<Dim> all_velocities(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                               const Eigen::VectorXd& v, double share);

}  // namespace seiche::contact
