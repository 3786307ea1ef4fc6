#pragma once
// Where the points of all bodies are after moving with given velocities.
#include <Eigen/Dense>

#include "solid/contact_surface.h"

namespace seiche::contact {

template <int Dim>
using Square = Eigen::Matrix<double, Dim, Dim>;
template <int Dim>
using Twists = std::vector<Eigen::Matrix<double, twist_size<Dim>, 1>>;  // one a body
template <int Dim>
constexpr int turn_size = twist_size<Dim> - Dim;
template <int Dim>
using Turn = Eigen::Matrix<double, turn_size<Dim>, 1>;  // angular velocity, rotation vector or torque

// exp of a rotation vector, and its left Jacobian: exp([a + da]) = exp([J_l da]) exp([a]) to first order.
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

// The interval: where everything starts, and the velocities that take prescribed bodies to their end poses.
template <int Dim>
struct Interval {
  double horizon = 0;             // s
  std::vector<Vec<Dim>> centers;  // of each body at the start
  std::vector<Vec<Dim>> arms;     // of all points from the centre of their body, at the start
  std::vector<double> radius;     // of each body: its longest arm
  Twists<Dim> prescribed;         // zero for free bodies
};

template <int Dim>
Interval<Dim> make_interval(const typename ContactScene<Dim>::Data& scene, const std::vector<ContactMotion>& motions,
                            double horizon);

// x = c + H v + exp(H omega) r.
template <int Dim>
struct Placement {
  Twists<Dim> twists;
  std::vector<Vec<Dim>> centers, points;
};

template <int Dim>
Placement<Dim> place(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                     const Twists<Dim>& twists);

// The fastest that a point of body b moves with the twist (m/s), and its rotation over the interval.
template <int Dim>
double speed_bound(const Interval<Dim>& interval, int b, const Eigen::Matrix<double, twist_size<Dim>, 1>& twist);

// The velocities of all bodies when free ones have theirs of the stacked v and prescribed ones `share` of theirs.
template <int Dim>
Twists<Dim> all_twists(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                       const Eigen::VectorXd& v, double share);

}  // namespace seiche::contact
