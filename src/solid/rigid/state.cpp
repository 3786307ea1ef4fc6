#include "solid/rigid/state.h"

#include "solid/rigid/motion.h"

namespace seiche {
namespace {

void hold_fixed_axes(const RigidSpec& spec, Vec3& linear, Vec3& angular) {
  for (int a = 0; a < 3; ++a) {
    if (spec.fixed_position[a]) linear[a] = 0;
    if (spec.fixed_rotation[a]) angular[a] = 0;
  }
}

// Mean angular velocity of the free rotation over dt; constant about a fixed axis and in 2D.
template <int Dim>
Vec3 free_angular_velocity(const Body<Dim>& body, const RigidState& r, double dt) {
  if (Dim == 2 || !turns_freely(body.spec().rigid)) return r.angular_velocity;
  return rotate_freely(principal_inertia(body.mass().inertia), r.rotation, r.angular_momentum, dt)
      .mean_angular_velocity;
}

}  // namespace

bool turns_freely(const RigidSpec& spec) {
  return !(spec.fixed_rotation[0] || spec.fixed_rotation[1] || spec.fixed_rotation[2]);
}

template <int Dim>
RigidState initial_rigid_state(const Body<Dim>& body) {
  RigidState r;
  r.center = body.mass().center;
  r.velocity = body.spec().rigid.velocity;
  r.angular_velocity = body.spec().rigid.angular_velocity;
  hold_fixed_axes(body.spec().rigid, r.velocity, r.angular_velocity);
  r.angular_momentum = body.mass().inertia * r.angular_velocity;
  return r;
}

template <int Dim>
Eigen::Matrix3d world_inertia(const Body<Dim>& body, const RigidState& r) {
  return r.rotation * body.mass().inertia * r.rotation.transpose();
}

template <int Dim>
Pose rigid_pose(const Body<Dim>& body, const RigidState& r) {
  return {r.rotation, body.mass().center, r.center - body.mass().center};
}

RigidState displaced(RigidState r, const Vec3& shift, const Vec3& turn) {
  r.center += shift;
  r.rotation = Eigen::Quaterniond(exp_rotation(turn) * r.rotation).normalized().toRotationMatrix();
  return r;
}

RigidState not_shown(const RigidState& r) {
  if (r.shown_shift.isZero(0) && r.shown_turn.isZero(0)) return r;
  RigidState moving = displaced(r, -r.shown_shift, -r.shown_turn);
  moving.shown_shift = moving.shown_turn = Vec3::Zero();
  return moving;
}

template <int Dim>
RigidState led_by(const Body<Dim>& body, const RigidState& r, const Twist& now, const Vec3& free, double horizon) {
  RigidState led = r;
  const Eigen::Matrix3d inertia = world_inertia(body, r);
  led.angular_momentum = turns_freely(body.spec().rigid) ? Vec3(r.angular_momentum + inertia * (now.angular - free))
                                                         : Vec3(inertia * now.angular);
  led.velocity = now.linear;
  led.angular_velocity = now.angular;
  led.horizon = horizon;
  return led;
}

template <int Dim>
RigidState gone_on(const Body<Dim>& body, const RigidState& r, const RigidState& led, double dt) {
  RigidState moving = r;
  moving.velocity = led.velocity;
  moving.angular_velocity = led.angular_velocity;
  moving.angular_momentum = led.angular_momentum;
  moving.horizon = led.horizon;
  const RigidState there = advance(body, moving, dt);
  RigidState next = r;
  next.center = there.center;
  next.rotation = there.rotation;
  const auto spin = [&](const RigidState& x) { return free_twist(body, x, Vec3::Zero(), 0, x.horizon).angular; };
  next.angular_velocity += spin(next) - spin(r);
  if (!turns_freely(body.spec().rigid)) next.angular_momentum = world_inertia(body, next) * next.angular_velocity;
  return next;
}

template <int Dim>
RigidState advance(const Body<Dim>& body, const RigidState& state, double dt) {
  const RigidState r = not_shown(state);
  RigidState next = r;
  Vec3 w = r.angular_velocity;
  if (dt != r.horizon && r.horizon > 0)
    w += free_angular_velocity(body, r, dt) - free_angular_velocity(body, r, r.horizon);
  next.center += dt * r.velocity;
  // Products of rotations drift from orthonormal by round-off; unit quaternions do not.
  next.rotation = Eigen::Quaterniond(exp_rotation(dt * w) * r.rotation).normalized().toRotationMatrix();
  return next;
}

template <int Dim>
Twist free_twist(const Body<Dim>& body, const RigidState& r, const Vec3& gravity, double dt, double horizon) {
  Twist v{r.velocity + dt * gravity, free_angular_velocity(body, r, horizon), r.center};
  hold_fixed_axes(body.spec().rigid, v.linear, v.angular);
  return v;
}

#define SEICHE_INSTANTIATE(D)                                                                          \
  template RigidState initial_rigid_state<D>(const Body<D>&);                                          \
  template Eigen::Matrix3d world_inertia<D>(const Body<D>&, const RigidState&);                        \
  template Pose rigid_pose<D>(const Body<D>&, const RigidState&);                                      \
  template RigidState advance<D>(const Body<D>&, const RigidState&, double);                           \
  template RigidState led_by<D>(const Body<D>&, const RigidState&, const Twist&, const Vec3&, double); \
  template RigidState gone_on<D>(const Body<D>&, const RigidState&, const RigidState&, double);        \
  template Twist free_twist<D>(const Body<D>&, const RigidState&, const Vec3&, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
