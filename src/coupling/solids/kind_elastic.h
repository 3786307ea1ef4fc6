#pragma once
// Elastic solids: their unknowns are the velocities of the nodes of their elements over the coming step.
#include "coupling/state/participant.h"
#include "coupling/state/state.h"
#include "solid/body/elastic_motion.h"

namespace seiche {

struct TimeSpec;

template <int Dim>
class ElasticParticipant : public Participant<Dim> {
 public:
  ElasticParticipant(const Body<Dim>& body, int index)
      : Participant<Dim>(body, index),
        motion_(initial_elastic_motion(body)),
        pin_forces_(Eigen::VectorXd::Zero(motion_.velocity.size())) {}
  using Participant<Dim>::body;
  std::unique_ptr<Participant<Dim>> copy() const override { return std::make_unique<ElasticParticipant>(*this); }
  const ElasticMotion& motion() const { return motion_; }
  ElasticMotion& motion() { return motion_; }

  Placement place(double t0, double t1, double t) const override;
  void set_velocity(Placement& placed) const override { placed.velocity = motion_.velocity; }
  double fastest_prescribed_part(double t, double dt) const override;
  int unknowns() const override { return elements().body.size(); }
  Eigen::VectorXd velocity() const override { return motion_.velocity; }
  Eigen::VectorXd velocity_over(double t, double dt, double horizon) const override;
  bool plans_steps() const override { return true; }

  void couple(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const override;
  void finish_columns(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const override;
  void take(const SolidCoupling<Dim>& c, int block, const Eigen::VectorXd& v, double horizon) override;
  void take_reactions(const Eigen::VectorXd& forces) override;
  void advance(const Stride<Dim>& stride) override;
  void inform(const Participant<Dim>& trial) override { motion_.velocity = trial.velocity(); }
  double possible_share(const Eigen::VectorXd& way) const override;
  double limit_of_start(double dt) const override;

  void describe_contact(ContactBody& contact) const override;
  ContactMotion contact_motion(double t, double horizon) const override;
  bool is_pinned() const override { return !elements().pins.empty(); }
  bool may_seal() const override;
  void describe_viscous(const StepGeometry<Dim>& g, ViscousSolid<Dim>& solid) const override;
  RigidField viscous_motion(const StepGeometry<Dim>& g) const override;
  void measure(const Gravity& gravity, const TimeSpec& time, const State<Dim>& state, StepStats& stats) const override;
  void describe(const TimeSpec& time, const State<Dim>& state, SolidState& out) const override;
  void add_loads(SolidState& out) const override;
  double driven_work(const Participant<Dim>& before, double t, double span) const override;
  double pull(double t) const override;

  void place_points(const Placement& placed, std::vector<Vec3>& points) const override;
  VolumeFrame volume() const override;
  std::string describe_mesh() const override;
  void visit(StateVisitor& visitor) override;

 protected:
  const ElasticSolid<Dim>& elements() const { return body().elastic(); }

 private:
  ElasticState as_solved(const Gravity& gravity, const TimeSpec& time, const State<Dim>& state) const;

  ElasticMotion motion_;
  Eigen::VectorXd pin_forces_;  // of the last solve on each unknown, N
};

// One pointer a solid; null: not elastic, or without elements.
template <int Dim>
ElasticMotions elastic_motions(const Participants<Dim>& solids);
template <int Dim>
ElasticMotion* elastic_motion(Participant<Dim>& participant) {
  auto* elastic = dynamic_cast<ElasticParticipant<Dim>*>(&participant);
  return elastic ? &elastic->motion() : nullptr;
}

}  // namespace seiche
