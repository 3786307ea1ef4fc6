#include "coupling/solids/kind_rigid.h"

#include <fmt/format.h>

#include "base/time_spec.h"
#include "coupling/solids/rigid_coupling.h"
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/state.h"
#include "linalg/core/dense_factors.h"
#include "solid/rigid/motion.h"

namespace seiche {

template <int Dim>
Placement RigidParticipant<Dim>::place(double, double, double) const {
  return {rigid_pose(body(), state_), Twist{{0, 0, 0}, {0, 0, 0}, state_.center}, {}, {}};
}

template <int Dim>
void RigidParticipant<Dim>::set_velocity(Placement& placed) const {
  placed.twist = {state_.velocity, state_.angular_velocity, state_.center};
}

template <int Dim>
Eigen::VectorXd RigidParticipant<Dim>::velocity() const {
  return stacked<Dim>(state_.velocity, state_.angular_velocity);
}

template <int Dim>
Eigen::VectorXd RigidParticipant<Dim>::unit_speeds() const {
  Eigen::VectorXd speeds = Eigen::VectorXd::Ones(twist_size<Dim>);
  speeds.tail(twist_size<Dim> - Dim).setConstant(body().radius());
  return speeds;
}

template <int Dim>
Eigen::VectorXd RigidParticipant<Dim>::generalised(const BodyImpulse& impulse) const {
  return stacked<Dim>(impulse.linear, impulse.angular);
}

template <int Dim>
void RigidParticipant<Dim>::couple(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const {
  couple_rigid_body(step, body(), state_, block, parts);
}

template <int Dim>
void RigidParticipant<Dim>::take_sums(const CoupledStep<Dim>& step, int block, const double* sums,
                                      SolidCoupling<Dim>& c) const {
  add_buoyancy(step, body(), c.bodies[std::size_t(block)], c.first[std::size_t(block)], sums, c);
}

// M target = M free + dt buoyancy_correction,  push = M target.
template <int Dim>
void RigidParticipant<Dim>::set_target(double dt, int block, SolidCoupling<Dim>& c) const {
  const int first = c.first[std::size_t(block)], n = twist_size<Dim>;
  const Eigen::MatrixXd M = c.mass.block(first, first, n, n);
  c.target.segment(first, n) =
      c.free.segment(first, n) + dt * DenseLdlt(M).solve(c.buoyancy_correction.segment(first, n));
  c.push.segment(first, n) = M * c.target.segment(first, n);
}

// L += I (omega - omega*), omega* of free rotation: the impulse of liquid and contact. With a fixed axis L = I omega.
template <int Dim>
void RigidParticipant<Dim>::take(const SolidCoupling<Dim>& c, int block, const Eigen::VectorXd& v, double horizon) {
  const int first = c.first[std::size_t(block)];
  RigidState& r = state_;
  const Twist now = unstacked<Dim>(v, 0, r.center), free = unstacked<Dim>(c.free, first, r.center);
  const Eigen::Matrix3d inertia = world_inertia(body(), r);
  r.angular_momentum = turns_freely(body().spec().rigid)
                           ? Vec3(r.angular_momentum + inertia * (now.angular - free.angular))
                           : Vec3(inertia * now.angular);
  r.velocity = now.linear;
  r.angular_velocity = now.angular;
  const Twist extra = unstacked<Dim>(c.buoyancy_correction, first, r.center);
  r.extra_force = extra.linear;
  r.extra_torque = extra.angular;
  r.horizon = horizon;
}

template <int Dim>
void RigidParticipant<Dim>::advance(const Stride<Dim>& stride) {
  if (stride.leading) return go_on(*stride.leading, stride.lead);
  state_ = seiche::advance(body(), state_, stride.lead);
}

template <int Dim>
void RigidParticipant<Dim>::go_on(const Participant<Dim>& leading, double dt) {
  const RigidState& led = static_cast<const RigidParticipant&>(leading).state_;
  RigidState moving = state_;
  moving.velocity = led.velocity;
  moving.angular_velocity = led.angular_velocity;
  moving.angular_momentum = led.angular_momentum;
  moving.horizon = led.horizon;
  const RigidState there = seiche::advance(body(), moving, dt);
  RigidState next = state_;
  next.center = there.center;
  next.rotation = there.rotation;
  const auto spin = [&](const RigidState& x) { return free_twist(body(), x, Vec3::Zero(), 0, x.horizon).angular; };
  next.angular_velocity += spin(next) - spin(state_);
  if (!turns_freely(body().spec().rigid)) next.angular_momentum = world_inertia(body(), next) * next.angular_velocity;
  state_ = next;
}

template <int Dim>
void RigidParticipant<Dim>::describe_contact(ContactBody& contact) const {
  contact.control = BodyControl::free;
  contact.mass = body().mass().mass;
}

template <int Dim>
ContactMotion RigidParticipant<Dim>::contact_motion(double, double) const {
  return {rigid_pose(body(), state_), {}, {}, velocity()};
}

template <int Dim>
void RigidParticipant<Dim>::describe_viscous(const StepGeometry<Dim>&, ViscousSolid<Dim>& solid) const {
  solid.rigid = true;
  solid.frame.center = state_.center;
}

template <int Dim>
RigidField RigidParticipant<Dim>::viscous_motion(const StepGeometry<Dim>&) const {
  return {state_.velocity, state_.angular_velocity, state_.center};
}

// E = 1/2 m v^2 + 1/2 w.L with w = I^-1 L, momentum m v, E_pot = -m g.x with gravity at that time.
template <int Dim>
void RigidParticipant<Dim>::measure(const Gravity& gravity, const TimeSpec& /*time*/, const State<Dim>& state,
                                    StepStats& stats) const {
  const double mass = body().mass().mass;
  const Vec3 w = angular_velocity(principal_inertia(body().mass().inertia), state_.rotation, state_.angular_momentum);
  stats.kinetic_energy += 0.5 * mass * state_.velocity.squaredNorm() + 0.5 * w.dot(state_.angular_momentum);
  stats.potential_energy -= mass * gravity.at(state.time).dot(state_.center);
  stats.momentum += mass * state_.velocity;
}

template <int Dim>
void RigidParticipant<Dim>::add_loads(SolidState& out) const {
  out.force += state_.extra_force;
  out.torque = out.torque + state_.extra_torque + (state_.center - out.position).cross(state_.extra_force);
}

template <int Dim>
void RigidParticipant<Dim>::visit(StateVisitor& visitor) {
  const std::string prefix = fmt::format("rigid.{}.", this->index());
  const auto visit_all = [&](const char* name, auto& v) {
    for (int i = 0; i < int(v.size()); ++i) visitor.number(fmt::format("{}{}{}", prefix, name, i), v.data()[i]);
  };
  visit_all("center", state_.center);
  visit_all("rotation", state_.rotation);
  visit_all("velocity", state_.velocity);
  visit_all("angular_velocity", state_.angular_velocity);
  visit_all("angular_momentum", state_.angular_momentum);
  visit_all("extra_force", state_.extra_force);
  visit_all("extra_torque", state_.extra_torque);
  visitor.number(prefix + "horizon", state_.horizon);
}

template class RigidParticipant<2>;
template class RigidParticipant<3>;

SolidKindRow rigid_solid() {
  return {SolidKind::rigid,
          "moved by the liquid, gravity and contacts",
          {},
          make_participant<RigidParticipant<2>>,
          make_participant<RigidParticipant<3>>};
}

}  // namespace seiche
