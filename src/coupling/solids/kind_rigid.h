#pragma once
// Rigid solids: their unknowns are the velocity of the centre of mass and the angular velocity.
#include "coupling/state/participant.h"
#include "coupling/state/state.h"
#include "solid/rigid/state.h"

namespace seiche {

struct TimeSpec;

template <int Dim>
class RigidParticipant : public Participant<Dim> {
 public:
  RigidParticipant(const Body<Dim>& body, int index)
      : Participant<Dim>(body, index), state_(initial_rigid_state(body)) {}
  using Participant<Dim>::body;
  std::unique_ptr<Participant<Dim>> copy() const override { return std::make_unique<RigidParticipant>(*this); }
  const RigidState* rigid() const override { return &state_; }
  const RigidState& state() const { return state_; }
  void set_state(const RigidState& state) { state_ = state; }

  Placement place(double t0, double t1, double t) const override;
  void set_velocity(Placement& placed) const override;
  int unknowns() const override { return twist_size<Dim>; }
  Eigen::VectorXd velocity() const override;
  Eigen::VectorXd unit_speeds() const override;
  Eigen::VectorXd generalised(const BodyImpulse& impulse) const override;

  void couple(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const override;
  void take_sums(const CoupledStep<Dim>& step, int block, const double* sums, CouplingParts<Dim>& parts) const override;
  void set_target(double dt, int block, SolidCoupling<Dim>& c) const override;
  void take(const SolidCoupling<Dim>& c, int block, const Eigen::VectorXd& v, double horizon) override;
  void advance(const Stride<Dim>& stride) override;
  void go_on(const Participant<Dim>& leading, double dt) override;

  void describe_contact(ContactBody& contact) const override;
  ContactMotion contact_motion(double t, double horizon) const override;
  void describe_viscous(const StepGeometry<Dim>& g, ViscousSolid<Dim>& solid) const override;
  RigidField viscous_motion(const StepGeometry<Dim>& g) const override;
  void measure(const Gravity& gravity, const TimeSpec& /*time*/, const State<Dim>& state,
               StepStats& stats) const override;
  void add_loads(SolidState& out) const override;
  void visit(StateVisitor& visitor) override;

 private:
  RigidState state_;
};

// Null: the participant is not rigid.
template <int Dim>
RigidParticipant<Dim>* rigid_participant(Participant<Dim>& participant) {
  return dynamic_cast<RigidParticipant<Dim>*>(&participant);
}

}  // namespace seiche
