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
                                      CouplingParts<Dim>& parts) const {
  add_buoyancy(step, body(), state_, block, sums, parts);
}

// M target = M free + dt buoyancy_correction,  push = M target. Fixed axes bear the correction's load.
template <int Dim>
void RigidParticipant<Dim>::set_target(double dt, int block, SolidCoupling<Dim>& c) const {
  const int first = c.first[std::size_t(block)], n = twist_size<Dim>;
  const Eigen::MatrixXd M = c.mass.block(first, first, n, n);
  Eigen::VectorXd load = c.buoyancy_correction.segment(first, n);
  for (int i = 0; i < n; ++i)
    if (c.is_held(first + i)) load[i] = 0;
  c.target.segment(first, n) = c.free.segment(first, n);
  if (!load.isZero(0)) c.target.segment(first, n) += dt * DenseLdlt(M).solve(load);
  c.push.segment(first, n) = M * c.target.segment(first, n);
}

template <int Dim>
void RigidParticipant<Dim>::take(const SolidCoupling<Dim>& c, int block, const Eigen::VectorXd& v, double horizon) {
  const int first = c.first[std::size_t(block)];
  state_ = led_by(body(), state_, unstacked<Dim>(v, 0, state_.center),
                  unstacked<Dim>(c.free, first, state_.center).angular, horizon);
  const Twist extra = unstacked<Dim>(c.buoyancy_correction, first, state_.center);
  state_.extra_force = extra.linear;
  state_.extra_torque = extra.angular;
}

template <int Dim>
void RigidParticipant<Dim>::advance(const Stride<Dim>& stride) {
  if (stride.leading) return go_on(*stride.leading, stride.lead);
  state_ = seiche::advance(body(), state_, stride.lead);
}

template <int Dim>
void RigidParticipant<Dim>::go_on(const Participant<Dim>& leading, double dt) {
  state_ = gone_on(body(), state_, static_cast<const RigidParticipant&>(leading).state_, dt);
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
  if (!visitor.has(prefix + "shown_shift0")) return;  // checkpoints of earlier versions
  visit_all("shown_shift", state_.shown_shift);
  visit_all("shown_turn", state_.shown_turn);
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
