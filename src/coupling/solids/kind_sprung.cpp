// Solids on a spring: a body that forces only translate, drawn to its place at rest. docs/adding-a-solid.md walks
// through this file.
#include <fmt/format.h>

#include "base/time_spec.h"
#include "coupling/solids/face_columns.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/state.h"

namespace seiche {
namespace {

// Displacement d and velocity v, Dim unknowns. With d where the solve finds the body:
//   m (v' - v)/dt = m g - k (d + dt (a v' - b v)) - c (v + v')/2 + loads.
// In leapfrog steps a = b = 1/4, the implicit midpoint rule: it keeps the spring's energy and is stable for any step.
// In others the body moves by dt v' next, and the same a and b are stable only while steps are equal. Steps beyond the
// spring's time 1/omega go over to a = 1, b = 0. This is implicit Euler, which damps an oscillation it cannot resolve.
template <int Dim>
class SprungParticipant : public Participant<Dim> {
 public:
  SprungParticipant(const Body<Dim>& body, int index)
      : Participant<Dim>(body, index), velocity_(truncate<Dim>(body.spec().rigid.velocity)) {}
  using Participant<Dim>::body;
  std::unique_ptr<Participant<Dim>> copy() const override { return std::make_unique<SprungParticipant>(*this); }

  Placement place(double, double, double) const override {
    const Vec3 center = body().mass().center, there = center + extend<Dim>(displacement_);
    return {Pose{Eigen::Matrix3d::Identity(), center, there - center}, Twist{{0, 0, 0}, {0, 0, 0}, there}, {}, {}};
  }
  void set_velocity(Placement& placed) const override { placed.twist.linear = extend<Dim>(velocity_); }

  int unknowns() const override { return Dim; }
  Eigen::VectorXd velocity() const override { return velocity_; }
  Eigen::VectorXd generalised(const BodyImpulse& impulse) const override { return truncate<Dim>(impulse.linear); }

  void couple(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const override {
    SolidCoupling<Dim>& c = parts.coupling;
    const int first = c.first[std::size_t(block)];
    const double dt = step.dt, m = mass(), k = stiffness(), damping = number("spring_damping");
    const Vec<Dim> g = truncate<Dim>(step.setup.fluids.gravity.of_step(step.state.time, dt));
    const bool leapfrog = step.state.since_solve > 0;
    const double unresolved = leapfrog ? 0 : std::clamp(dt * std::sqrt(k / m) - 1, 0.0, 1.0);
    const double after = 0.25 + 0.75 * unresolved, before = 0.25 * (1 - unresolved), damped = dt * damping / 2;
    const double mass = m + dt * dt * k * after + damped;
    for (int a = 0; a < Dim; ++a) parts.mass.emplace_back(first + a, first + a, mass);
    c.push.segment(first, Dim) = (m + dt * dt * k * before - damped) * velocity_ + dt * (m * g - k * displacement_);
    c.free.segment(first, Dim) = c.push.segment(first, Dim) / mass;
    c.J.blocks[std::size_t(block)] = translation_columns(step, this->index(), c.freedom, first);
  }
  void take(const SolidCoupling<Dim>&, int, const Eigen::VectorXd& v, double) override { velocity_ = v; }
  void advance(const Stride<Dim>& stride) override { go_on(stride.leading ? *stride.leading : *this, stride.lead); }
  void go_on(const Participant<Dim>& leading, double dt) override {
    displacement_ += dt * Vec<Dim>(leading.velocity());
  }

  // The first step advances with the initial velocity: k (dt v)^2/2 <= 1e-3 m v^2/2.
  double limit_of_start(double dt) const override {
    constexpr double share = 1e-3;
    if (velocity_.isZero(0) || stiffness() == 0) return dt;
    return std::min(dt, std::sqrt(share * mass() / stiffness()));
  }

  // One node carries the whole surface.
  void describe_contact(ContactBody& contact) const override {
    contact.control = BodyControl::deformable;
    contact.mass = mass();
    contact.nodes.assign(contact.surface.points.size(), 0);
    contact.node_count = 1;
  }
  ContactMotion contact_motion(double, double) const override { return {{}, {}, displacement_, velocity_}; }
  RigidField viscous_motion(const StepGeometry<Dim>&) const override {
    return {extend<Dim>(velocity_), Vec3::Zero(), body().mass().center + extend<Dim>(displacement_)};
  }
  void describe_viscous(const StepGeometry<Dim>& g, ViscousSolid<Dim>& solid) const override {
    solid.frame = viscous_motion(g);
    solid.surface = [](int axis, Site, std::vector<std::pair<int, double>>& weights) { weights = {{axis, 1.0}}; };
  }

  // v belongs to the middle of the way that it leads, which after a leapfrog step is the present place.
  void measure(const Gravity& gravity, const TimeSpec& /*time*/, const State<Dim>& state,
               StepStats& stats) const override {
    const Vec3 x = body().mass().center + extend<Dim>(displacement_);
    const double to_middle = state.since_solve > 0 ? 0 : 0.5 * state.dt_now;
    stats.kinetic_energy += 0.5 * mass() * velocity_.squaredNorm();
    stats.elastic_energy += 0.5 * stiffness() * (displacement_ + to_middle * velocity_).squaredNorm();
    stats.potential_energy -= mass() * gravity.at(state.time).dot(x);
    stats.momentum += mass() * extend<Dim>(velocity_);
  }
  void visit(StateVisitor& visitor) override {
    for (int a = 0; a < Dim; ++a) {
      visitor.number(fmt::format("sprung.{}.displacement{}", this->index(), a), displacement_[a]);
      visitor.number(fmt::format("sprung.{}.velocity{}", this->index(), a), velocity_[a]);
    }
  }

 private:
  double mass() const { return body().mass().mass; }
  double stiffness() const { return number("spring_stiffness"); }
  double number(const std::string& key) const {
    const auto found = body().spec().numbers.find(key);
    return found == body().spec().numbers.end() ? 0 : found->second;
  }

  Vec<Dim> displacement_ = Vec<Dim>::Zero(), velocity_;
};

}  // namespace

SolidKindRow sprung_solid() {
  const SolidKind kind{.name = "sprung", .drive = Drive::forces, .may_turn = false};
  return {kind,
          "translated by them, and by a spring that draws it to where it is at rest",
          {{.key = "spring_stiffness",
            .unit = "N/m",
            .range = between(0, number_limit),
            .presence = Presence::required,
            .doc = "force of the spring over displacement; 2D: per metre of depth"},
           {.key = "spring_damping",
            .unit = "N s/m",
            .range = between(0, number_limit),
            .unset = "none",
            .doc = "force of a damper over velocity; 2D: per metre of depth"}},
          make_participant<SprungParticipant<2>>,
          make_participant<SprungParticipant<3>>};
}

}  // namespace seiche
