#pragma once
// Whatever moves liquid or has unknowns: one class a kind of solid. solid_kinds.h has the table of them.
#include <memory>
#include <string>
#include <vector>

#include "base/gravity.h"
#include "base/time_spec.h"
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/simulation.h"
#include "fluid/viscosity/viscosity.h"
#include "solid/contact/contact.h"

namespace seiche {

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

// Visits all that a participant keeps from step to step: one list serves saving and loading.
class StateVisitor {
 public:
  virtual ~StateVisitor() = default;
  virtual void number(const std::string& name, double& value) = 0;
  virtual void vector(const std::string& name, Eigen::VectorXd& value) = 0;  // its size stays
};

// A step that participants go. `velocity`: of the unknowns over it. They go to where the solve finds them, `lead` from
// its start: the whole step, or half of it where steps go by halves.
template <int Dim>
struct Stride {
  const Setup<Dim>& setup;
  const State<Dim>& before;
  double dt, lead;
  const Eigen::VectorXd& velocity;
};

// A solid of the scene with what it keeps from step to step. A value: State owns copies. The defaults are those of a
// solid that neither moves nor has unknowns. Velocities are those of its unknowns, stacked.
template <int Dim>
class Participant {
 public:
  // `index` is that in the scene. The body must outlive it.
  Participant(const Body<Dim>& body, int index) : body_(&body), index_(index) {}
  virtual ~Participant() = default;
  virtual std::unique_ptr<Participant> copy() const = 0;
  const Body<Dim>& body() const { return *body_; }
  int index() const { return index_; }

  // Where it stands: as prescribed at t with the mean velocity from t0 to t1, or as it is, at rest.
  virtual Placement place(double /*t0*/, double /*t1*/, double /*t*/) const { return {}; }
  // Its velocity over the step to come, where it has unknowns.
  virtual void set_velocity(Placement&) const {}
  // What of a placement's velocities is prescribed, and the fastest that prescribed parts move from t to t + dt, m/s.
  virtual Placement prescribed_part(Placement placed) const;
  virtual double fastest_prescribed_part(double /*t*/, double /*dt*/) const { return 0; }

  // The unknowns: their number, their velocities as the last solve left them, and over a step of dt from t where
  // `horizon` was planned.
  virtual int unknowns() const { return 0; }
  virtual Eigen::VectorXd velocity() const { return {}; }
  virtual Eigen::VectorXd velocity_over(double /*t*/, double /*dt*/, double /*horizon*/) const { return velocity(); }
  // Speed of the farthest point where an unknown is one.
  virtual Eigen::VectorXd unit_speeds() const { return Eigen::VectorXd::Ones(unknowns()); }
  // An impulse about the centre of mass as one on the unknowns.
  virtual Eigen::VectorXd generalised(const BodyImpulse&) const { return Eigen::VectorXd::Zero(unknowns()); }
  // Whether a solve must lead it to the end of the coming step, which is then planned ahead.
  virtual bool plans_steps() const { return false; }

  // Adds inertia, columns of J, what is held, potentials. Numbers put into parts.sums come back in take_sums(), summed
  // over the ranks. set_target() comes last, when the mass matrix is there. Collective.
  virtual void couple(const CoupledStep<Dim>&, int /*block*/, CouplingParts<Dim>&) const {}
  virtual void take_sums(const CoupledStep<Dim>&, int /*block*/, const double* /*sums*/, SolidCoupling<Dim>&) const {}
  virtual void finish_columns(const CoupledStep<Dim>&, int /*block*/, CouplingParts<Dim>&) const {}
  virtual void set_target(double /*dt*/, int /*block*/, SolidCoupling<Dim>&) const {}

  // After a solve: its velocities `v` over `horizon`, and the forces that hold what is held (N; zero where it is free).
  virtual void take(const SolidCoupling<Dim>&, int /*block*/, const Eigen::VectorXd& /*v*/, double /*horizon*/) {}
  virtual void take_reactions(const Eigen::VectorXd& /*forces*/) {}
  virtual void advance(const Stride<Dim>&) {}
  // The other half of a step by halves, with the velocities of `leading`.
  virtual void go_on(const Participant& /*leading*/, double /*dt*/) {}
  // The share of a way of its unknowns (m) that it can go without damage; the longest first step up to dt.
  virtual double possible_share(const Eigen::VectorXd& /*way*/) const { return 1; }
  virtual double limit_of_start(double dt) const { return dt; }

  // As contact sees it.
  virtual void describe_contact(ContactBody&) const;
  virtual ContactMotion contact_motion(double t, double horizon) const;
  virtual bool is_pinned() const { return false; }
  // Whether liquid may be sealed by it together with what its pins stand on.
  virtual bool may_seal() const { return false; }
  // As viscous liquid sees it, and its motion.
  virtual void describe_viscous(const StepGeometry<Dim>&, ViscousSolid<Dim>&) const;
  virtual RigidField viscous_motion(const ViscousSolid<Dim>& solid) const { return solid.frame; }

  // Adds energies and momentum; what solids.csv has of it: place and motion before the loads are known, then loads
  // beyond the pressure on its faces.
  virtual void measure(const Gravity&, const TimeSpec&, const State<Dim>&, StepStats&) const {}
  virtual void describe(const TimeSpec&, const State<Dim>&, SolidState&) const {}
  virtual void add_loads(SolidState&) const {}
  // sum f^2/m of the forces that the scene applies at t beside gravity.
  virtual double pull(double /*t*/) const { return 0; }

  // For frames: the surface at rest within the domain, its points as placed, and elements.
  virtual SurfaceMesh surface_at_rest(const DomainSpec& domain) const;
  virtual void place_points(const Placement& placed, std::vector<Vec3>& points) const;
  virtual VolumeFrame volume() const { return {}; }
  virtual std::string describe_mesh() const { return {}; }

  virtual void visit(StateVisitor&) {}

 private:
  const Body<Dim>* body_;
  int index_;
};

// For rows of the table of kinds: makes a participant of this class.
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
