#pragma once
// Participants: all that moves liquid or has unknowns, one class per kind of solid. solid_kinds.h has the table.
#include <memory>
#include <string>
#include <vector>

#include "base/gravity.h"
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/simulation.h"
#include "coupling/state/state_visitor.h"
#include "fluid/viscosity/viscosity.h"
#include "solid/contact/contact.h"

namespace seiche {

struct DomainSpec;
struct TimeSpec;

template <int Dim>
struct Setup;
template <int Dim>
struct State;
template <int Dim>
struct SolidCoupling;
template <int Dim>
struct CouplingParts;
template <int Dim>
struct CoupledStep;

template <int Dim>
class Participant;

// Advance over one step. Participants move to their position at the solve, `lead` (s) after the start of the step: dt,
// or dt/2 in leapfrog steps. `velocity`: of the participant's unknowns over the step. `leading`: the participant after
// a look ahead, whose velocities move it, or null.
template <int Dim>
struct Stride {
  const Setup<Dim>& setup;
  const State<Dim>& before;
  double dt, lead;
  const Eigen::VectorXd& velocity;
  const Participant<Dim>* leading = nullptr;
};

// A solid of the scene with the data that it keeps from step to step. A value: State owns copies. The defaults suit a
// solid that neither moves nor has unknowns. Velocities are those of its unknowns, stacked.
template <int Dim>
class Participant {
 public:
  // `index`: its number in the scene. `body` must outlive the participant.
  Participant(const Body<Dim>& body, int index) : body_(&body), index_(index) {}
  virtual ~Participant() = default;
  virtual std::unique_ptr<Participant> copy() const = 0;
  const Body<Dim>& body() const { return *body_; }
  int index() const { return index_; }

  // Placement at time t. Prescribed solids: pose at t, mean velocity from t0 to t1. Others: present pose, zero
  // velocity.
  virtual Placement place(double /*t0*/, double /*t1*/, double /*t*/) const { return {}; }
  // Sets the velocity of a placement to that of the unknowns over the coming step.
  virtual void set_velocity(Placement&) const {}
  // The placement with only its prescribed velocities, and a bound of the speed of pins from t to t + dt, m/s.
  virtual Placement prescribed_part(Placement placed) const;
  virtual double fastest_prescribed_part(double /*t*/, double /*dt*/) const { return 0; }

  // State of a body that forces move rigidly; null for others.
  virtual const RigidState* rigid() const { return nullptr; }

  // Number of unknowns, their velocities from the last solve, and their velocities over a step of dt from t. `horizon`:
  // the interval that the last solve planned. All times in s.
  virtual int unknowns() const { return 0; }
  virtual Eigen::VectorXd velocity() const { return {}; }
  virtual Eigen::VectorXd velocity_over(double /*t*/, double /*dt*/, double /*horizon*/) const { return velocity(); }
  // Largest speed of a point of the body per unit of each unknown.
  virtual Eigen::VectorXd unit_speeds() const { return Eigen::VectorXd::Ones(unknowns()); }
  // Converts an impulse about the centre of mass to one on the unknowns.
  virtual Eigen::VectorXd generalised(const BodyImpulse&) const { return Eigen::VectorXd::Zero(unknowns()); }
  // True if each solve determines its path to the end of the coming step, which is then planned ahead.
  virtual bool plans_steps() const { return false; }

  // Contributions to the coupled problem: inertia, columns of J, fixed unknowns, potentials. Numbers appended to
  // parts.sums return in take_sums(), summed over the ranks. set_target() comes last, once the mass matrix exists.
  // `block`: index in SolidCoupling::bodies. Collective.
  virtual void couple(const CoupledStep<Dim>&, int /*block*/, CouplingParts<Dim>&) const {}
  virtual void take_sums(const CoupledStep<Dim>&, int /*block*/, const double* /*sums*/, CouplingParts<Dim>&) const {}
  virtual void finish_columns(const CoupledStep<Dim>&, int /*block*/, CouplingParts<Dim>&) const {}
  virtual void set_target(double /*dt*/, int /*block*/, SolidCoupling<Dim>&) const {}

  // Results of a solve: velocities `v` of the unknowns over `horizon` (s), and forces that hold fixed unknowns (N; zero
  // for free unknowns).
  virtual void take(const SolidCoupling<Dim>&, int /*block*/, const Eigen::VectorXd& /*v*/, double /*horizon*/) {}
  virtual void take_reactions(const Eigen::VectorXd& /*forces*/) {}
  virtual void advance(const Stride<Dim>&) {}
  // Velocities of the first step from a look ahead.
  virtual void inform(const Participant& /*trial*/) {}
  // Second half of a leapfrog step, dt (s), with the velocities of `leading`.
  virtual void go_on(const Participant& /*leading*/, double /*dt*/) {}
  // Fraction of the displacement `way` (m) of its unknowns that it can move without damage, and the longest first step
  // up to dt (s).
  virtual double possible_share(const Eigen::VectorXd& /*way*/) const { return 1; }
  virtual double limit_of_start(double dt) const { return dt; }

  // Data for contact: description and motion from t over the horizon. Default: prescribed body.
  virtual void describe_contact(ContactBody&) const;
  virtual ContactMotion contact_motion(double t, double horizon) const;
  // True if parts of it are pinned.
  virtual bool is_pinned() const { return false; }
  // True if it may seal liquid together with the solids that its pins stand on.
  virtual bool may_seal() const { return false; }
  // Data for the viscous operator: description, and rigid (or mean) motion of the solid.
  virtual void describe_viscous(const StepGeometry<Dim>&, ViscousSolid<Dim>&) const;
  virtual RigidField viscous_motion(const StepGeometry<Dim>&) const;

  // Adds energies and momentum to the statistics. describe() and add_loads() fill its row of solids.csv: first position
  // and motion, later the loads other than pressure on its faces.
  virtual void measure(const Gravity&, const TimeSpec&, const State<Dim>&, StepStats&) const {}
  virtual void describe(const TimeSpec&, const State<Dim>&, SolidState&) const {}
  virtual void add_loads(SolidState&) const {}
  // Work (J) of pins, and of the forces that the scene applies, gravity excluded, over the way of the last solve from t
  // to t + span. `before`: the participant before that solve.
  virtual double driven_work(const Participant& /*before*/, double /*t*/, double /*span*/) const { return 0; }
  // sum f^2/m of the forces (N) that the scene applies at time t, gravity excluded.
  virtual double pull(double /*t*/) const { return 0; }

  // For frames: surface at rest within the domain, points moved to a placement, elements. For the log: the mesh.
  virtual SurfaceMesh surface_at_rest(const DomainSpec& domain) const;
  virtual void place_points(const Placement& placed, std::vector<Vec3>& points) const;
  virtual VolumeFrame volume() const { return {}; }
  virtual std::string describe_mesh() const { return {}; }

  virtual void visit(StateVisitor&) {}

 private:
  const Body<Dim>* body_;
  int index_;
};

// Makes a participant of `Class`, for rows of the table of kinds.
template <class Class, int Dim>
std::unique_ptr<Participant<Dim>> make_participant(const Body<Dim>& body, int index) {
  return std::make_unique<Class>(body, index);
}

// The solids of a scene, in its order. Copies are deep.
template <int Dim>
class Participants {
 public:
  Participants() = default;
  explicit Participants(std::vector<std::unique_ptr<Participant<Dim>>> list) : list_(std::move(list)) {}
  Participants(const Participants& other) {
    for (const auto& p : other.list_) list_.push_back(p->copy());
  }
  Participants(Participants&&) noexcept = default;
  Participants& operator=(Participants other) noexcept {
    list_ = std::move(other.list_);
    return *this;
  }

  std::size_t size() const { return list_.size(); }
  Participant<Dim>& operator[](std::size_t k) { return *list_[k]; }
  const Participant<Dim>& operator[](std::size_t k) const { return *list_[k]; }
  template <class Holds>
  bool any(const Holds& holds) const {
    for (const auto& p : list_)
      if (holds(*p)) return true;
    return false;
  }

 private:
  std::vector<std::unique_ptr<Participant<Dim>>> list_;
};

}  // namespace seiche
