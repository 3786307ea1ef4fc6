// Newton's method on e(v) + C(v) + P(v) with a collision-free line search (Li et al. 2020).
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "solid/contact/friction_updates.h"
#include "solid/contact/pair_impulses.h"
#include "solid/contact/path.h"

namespace seiche {
namespace contact {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo
constexpr double energy_round_off = 1e-12;    // of the sum of the energies: smaller differences are noise
constexpr double least_step = 1e-10;          // of a Newton step; below it the line search fails
// Gaps below this share of the reach: kappa is multiplied by `stiffening`, at most `stiffening_limit` times.
constexpr double tiny_gap = 1e-2, stiffening = 10;
constexpr int stiffening_limit = 12;
// Rotations in a Newton step, rad: below the first one arcs are left aside, up to the second one they are tried if the
// energy rises along the whole line. The third is the most of an arc that is tried at once.
constexpr double least_angle = 1e-4, small_angle = 0.05, most_angle = 0.5;
// Convergence of the lagged friction forces: their update moves no point faster than this share of the creep speed, or
// of the velocity change by contact. Friction is then accurate to 1e-3.
constexpr double settled_share = 0.1, settled_of_change = 1e-4;
// Newton's tolerance relative to the velocity change by contact: before friction is known, and in the end. In between
// it shrinks by `sharpening` with each update of friction, down to this share of the motion that the last update
// caused: forces that will change need no accurate minimum.
constexpr double first_of_change = 0.3, last_of_change = 1e-6, sharpening = 0.5, worth_resolving = 0.1;

enum class Outcome { converged, failed };

template <int Dim>
class Solver {
 public:
  Solver(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon, double dt,
         InertiaProblem& inertia, const ContactOptions& options, const VelocityPotential* potential)
      : scene_(scene.data()), inertia_(inertia), options_(options), potential_(potential) {
    interval_ = make_interval<Dim>(scene_, motions, horizon);
    guess_ = stacked_guess(motions);
    weights_ = {dt, options.reach, stiffness_for(heaviest() * options.acceleration, options.reach),
                options.creep_speed};
    for (const auto& twist : interval_.prescribed)
      if (!twist.isZero(0)) share_ = 0;
  }

  ContactReport run(const Eigen::VectorXd& start) {
    if (free_of_contact()) return report_;
    if (!report_.failure.empty() || !begin(start)) return report_;
    for (int i = 0; i < stiffening_limit; ++i) {
      if (solve_with_friction() == Outcome::failed) return report_;
      if (!stiffen()) break;
    }
    finish();
    return report_;
  }

 private:
  double heaviest() const {
    double mass = 0;
    for (size_t b = 0; b < scene_.mass.size(); ++b)
      if (scene_.moves(static_cast<int>(b))) mass = std::max(mass, scene_.mass[b]);
    return mass > 0 ? mass : 1;
  }

  Eigen::VectorXd stacked_guess(const std::vector<ContactMotion>& motions) const {
    Eigen::VectorXd guess = Eigen::VectorXd::Zero(scene_.size);
    for (size_t b = 0; b < motions.size(); ++b)
      if (scene_.moves(static_cast<int>(b)) && motions[b].guess.size() > 0)
        guess.segment(scene_.first_dof[b], motions[b].guess.size()) = motions[b].guess;
    return guess;
  }

  // Stores the response; fails if it is unusable.
  Outcome take(InertiaResponse response, InertiaResponse& into) {
    ++report_.solves;
    if (!response.failure.empty())
      report_.failure = response.failure;
    else if (response.shape == Shape::convex && !(response.velocity.allFinite() && response.gradient.allFinite()))
      report_.failure = "the velocities of the bodies are not finite";
    into = std::move(response);
    return report_.failure.empty() ? Outcome::converged : Outcome::failed;
  }

  Velocities<Dim> velocities(const Eigen::VectorXd& v, double share) const {
    return all_velocities<Dim>(scene_, interval_, v, share);
  }

  // True while prescribed bodies or degrees of freedom have not reached their prescribed velocities.
  bool under_way() const { return share_ < 1 || !inertia_.holds(e_.velocity); }

  // Minimum of e alone. It is the solution if no contact is active, since e has no lower value. Not tried with a
  // potential.
  bool free_of_contact() {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(inertia_.size());
    free_velocity_ = zero;
    if (potential_) return false;
    const Eigen::SparseMatrix<double> none(zero.size(), zero.size());
    at_ = place<Dim>(scene_, interval_, velocities(zero, share_));
    if (take(inertia_.minimise(none, zero), e_) == Outcome::failed) return false;
    if (e_.shape == Shape::indefinite) {
      fail("contact: the energy of the bodies' inertia is not convex");
      return false;
    }
    free_velocity_ = e_.velocity;
    const Walk<Dim> way = walk<Dim>(scene_, interval_, at_, velocities(e_.velocity, 1), weights_.reach);
    if (way.share < 1) return false;
    if (contact_energy<Dim>(scene_, interval_, way.end, way.near, {}, weights_) > 0) return false;
    report_.velocity = e_.velocity;
    report_.gradient = report_.residual = e_.gradient;
    report_.smallest_gap = weights_.reach;
    report_.stiffness = weights_.stiffness;
    report_.impulses.resize(scene_.surfaces.size());
    return true;
  }

  // Moves from rest along the guess as far as nothing inverts, and half as far as nothing collides: barriers of tight
  // gaps are stiff. Not where a Hessian that is indefinite there may go unnoticed. Rigid bodies alone do not use it:
  // among 200 boxes it saved a tenth of the iterations, in tumbling stacks it cost more.
  Eigen::VectorXd follow_guess() {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(scene_.size);
    if (!potential_ || guess_.isZero(0) || !inertia_.notices_indefinite()) return rest;
    potential_->turn(rest, guess_);
    guess_ *= potential_->step_bound(rest, guess_);
    const double left = 1 - share_;
    double s = walk<Dim>(scene_, interval_, at_, velocities(guess_, 1), weights_.reach).share;
    if (s < 1) s /= 2;
    Walk<Dim> way = walk<Dim>(scene_, interval_, at_, velocities(s * guess_, share_ + s * left), weights_.reach);
    s *= way.share;
    if (!std::isfinite(contact_energy<Dim>(scene_, interval_, way.end, way.near, {}, weights_))) return rest;
    at_ = std::move(way.end);
    pairs_ = std::move(way.near);
    share_ += s * left;
    return s * guess_;
  }

  // Places the bodies with velocities v. Returns what forbids Newton's method to start there; empty: nothing.
  std::string obstacle_at(const Eigen::VectorXd& v) {
    at_ = place<Dim>(scene_, interval_, velocities(v, share_));
    pairs_ = find_candidates<Dim>(scene_, at_.points, at_.points, weights_.reach);
    if (!std::isfinite(contact_energy<Dim>(scene_, interval_, at_, pairs_, {}, weights_)))
      return "bodies touch or overlap at the start of the step";
    if (potential_ && !std::isfinite(potential_->energy(v)))
      return "elements of elastic bodies are inverted at the start of the step";
    return {};
  }

  // Starts with all of an earlier solve's motion if nothing collides there, else at rest or on the way of the guess.
  bool begin(const Eigen::VectorXd& start) {
    Eigen::VectorXd v = start;
    const double share = start.size() > 0 ? std::exchange(share_, 1.0) : share_;
    if (start.size() == 0 || !obstacle_at(start).empty()) {
      share_ = share;
      report_.failure = obstacle_at(Eigen::VectorXd::Zero(inertia_.size()));
      if (report_.failure.empty()) v = follow_guess();
    }
    return report_.failure.empty() && take(inertia_.respond(v), e_) == Outcome::converged;
  }

  // Alternates Newton's method and updates of the friction forces until these converge.
  Outcome solve_with_friction() {
    report_.friction = FrictionState::none;
    double share = may_rub() ? first_of_change : last_of_change;
    friction_.restart();
    for (int i = 0; i < options_.friction_limit; ++i, share = next_share(share)) {
      const bool rubbed = !friction_.points().empty();
      friction_.update(scene_, at_, pairs_, weights_);
      const bool rubs = !friction_.points().empty();
      if (i > 0 && !rubs && !rubbed && last_step_ <= tolerance(last_of_change)) return Outcome::converged;
      report_.friction_updates += rubs;
      if (rubs) report_.friction = FrictionState::unsettled;
      if (newton(i > 0 && !rubs ? last_of_change : share) == Outcome::failed) return Outcome::failed;
      const double settled = std::max(settled_share * options_.creep_speed, settled_of_change * change());
      if (friction_.go_round()) break;
      if (i == 0 || first_step_ > friction_.share() * settled) continue;
      if (rubs) report_.friction = FrictionState::settled;
      break;
    }
    return last_step_ > tolerance(last_of_change) ? newton(last_of_change) : Outcome::converged;
  }

  // Half the tolerance of before, but no less than a tenth of the change by the last update of friction.
  double next_share(double share) const {
    const double moved = change() > 0 ? worth_resolving * first_step_ / change() : 0;
    return std::max(last_of_change, std::min(share, std::max(sharpening * share, moved)));
  }

  // Velocity change by contact (m/s); with a potential, the velocities' own size.
  double change() const { return fastest(e_.velocity - free_velocity_); }

  bool may_rub() const {
    return std::any_of(scene_.friction.begin(), scene_.friction.end(),
                       [](const auto& mu) { return mu.value_or(0) > 0; });
  }

  double tolerance(double share_of_change) const {
    return std::max(options_.speed_tolerance, share_of_change * change());
  }

  // Until a step moves no point faster than tolerance(share_of_change), and what is prescribed is reached.
  Outcome newton(double share_of_change) {
    for (int i = 0; i < options_.newton_limit; ++i) {
      ++report_.newton_iterations;
      InertiaResponse goal;
      if (aim(goal) == Outcome::failed) return Outcome::failed;
      last_step_ = fastest(goal.velocity - e_.velocity);
      if (i == 0) first_step_ = last_step_;
      const bool small = last_step_ <= tolerance(share_of_change), last = small && !under_way();
      const Velocities<Dim> from = at_.velocities;
      const double step = !last && takes_arc(goal) ? 1 : search(goal);
      friction_.turn(from, velocities(goal.velocity, 1), weights_.creep_speed);
      if (last || (small && !under_way())) return Outcome::converged;
      if (step == 0) return fail("contact: no step downhill is free of collisions");
    }
    return fail("contact: Newton's method does not converge");
  }

  // Minimum of e plus the quadratic model of C and P at the present iterate. If the exact model is indefinite, the
  // projected Hessian is used.
  Outcome aim(InertiaResponse& goal) {
    for (HessianProjection curvature : {HessianProjection::exact, HessianProjection::convex}) {
      terms_ = contact_terms<Dim>(scene_, interval_, at_, pairs_, friction_.points(), weights_, curvature,
                                  inertia_.columns());
      if (potential_) add_potential(curvature);
      const Eigen::VectorXd r = inertia_.multiply(terms_.K, e_.velocity) - terms_.gradient - terms_.drag;
      inertia_.linearise_at(e_.velocity);
      if (take(inertia_.minimise(terms_.K, r), goal) == Outcome::failed) return Outcome::failed;
      if (goal.shape == Shape::convex && options_.keeps_hessian) report_.hessian = terms_.K;
      if (goal.shape == Shape::convex) return Outcome::converged;
    }
    return fail("contact: the energy of the bodies' inertia is not convex");
  }

  void add_potential(HessianProjection curvature) {
    potential_->add_gradient(e_.velocity, terms_.gradient);
    terms_.K += potential_->hessian(e_.velocity, curvature, inertia_.columns());
    terms_.energy += potential_->energy(e_.velocity);
  }

  Outcome fail(const std::string& why) {
    report_.failure = why;
    return Outcome::failed;
  }

  double fastest(const Eigen::VectorXd& v) const { return contact::fastest<Dim>(scene_, interval_, v); }

  // grad e at the present iterate. With constraints, the goal's multipliers replace the present ones, so that steps
  // towards a constraint are descent directions too.
  Eigen::VectorXd gradient_towards(const InertiaResponse& goal) const {
    if (goal.constraint.size() == 0) return e_.gradient;
    return e_.gradient - e_.constraint + goal.constraint;
  }

  // e(v + s p) - e(v) for a quadratic with known gradients at v and v + p.
  double inertia_change(const InertiaResponse& goal, double s) const {
    const Eigen::VectorXd p = goal.velocity - e_.velocity, gradient = gradient_towards(goal);
    return s * p.dot(gradient + 0.5 * s * (goal.gradient - gradient));
  }

  // Line search: the longest step that is free of collisions and inversion and decreases the energy. Returns the share
  // of the step, 0 on failure. Energies are not compared until prescribed degrees of freedom have reached their values,
  // nor where the minimum of a convex model seems to lie uphill: the gradient of e, by which energies are compared, is
  // then wrong by more than the way is worth, as after a start within the error of the liquid's solve from the minimum.
  double search(const InertiaResponse& goal) {
    const Eigen::VectorXd p = goal.velocity - e_.velocity;
    const double slope = p.dot(gradient_towards(goal) + terms_.gradient), left = 1 - share_;
    const bool misled = slope >= 0 && inertia_.notices_indefinite(), compares = !under_way() && !misled;
    for (double s = potential_ ? potential_->step_bound(e_.velocity, p) : 1; s > least_step; s *= 0.5) {
      Walk<Dim> way =
          walk<Dim>(scene_, interval_, at_, velocities(e_.velocity + s * p, share_ + s * left), weights_.reach);
      s *= way.share;
      if (s <= least_step) break;
      const double energy = energy_after(way, s * p);
      const double inertia = inertia_change(goal, s);
      double noise = energy_round_off * (std::abs(inertia) + energy + terms_.energy);
      if (potential_) noise += potential_->round_off();
      if (!std::isfinite(energy)) continue;
      if (compares && inertia + energy - terms_.energy > sufficient_decrease * s * std::min(slope, 0.) + noise)
        continue;
      accept(std::move(way), goal, s);
      share_ = s == 1 ? 1 : share_ + s * left;
      return s;
    }
    return 0;
  }

  // True if the whole straight step lowers e + P, contact left aside.
  bool descends(const InertiaResponse& goal, const Eigen::VectorXd& p) const {
    Eigen::VectorXd gradient = gradient_towards(goal);
    potential_->add_gradient(e_.velocity, gradient);
    const double slope = p.dot(gradient);
    const double rise = potential_->energy(e_.velocity + p) - potential_->energy(e_.velocity);
    return inertia_change(goal, 1) + rise <= sufficient_decrease * std::min(slope, 0.) + potential_->round_off();
  }

  // Bodies that turn: a straight step as long as the energy allows is a small share of the turn if they are stiff, and
  // hundreds of them follow. Tries the arc instead, at most half a radian of it. It costs a solve of the liquid, since
  // e is known along the straight step alone. Returns true if it was taken.
  bool takes_arc(const InertiaResponse& goal) {
    if (!potential_ || under_way()) return false;
    Eigen::VectorXd p = goal.velocity - e_.velocity;
    const double angle = potential_->angle(e_.velocity, p), slope = p.dot(gradient_towards(goal) + terms_.gradient);
    if (angle < least_angle || (angle < small_angle && descends(goal, p))) return false;
    const double s = std::min(1.0, most_angle / angle);
    p *= s;
    potential_->turn(e_.velocity, p);
    Walk<Dim> way = walk<Dim>(scene_, interval_, at_, velocities(e_.velocity + p, 1), weights_.reach);
    const double energy = way.share < 1 ? std::numeric_limits<double>::infinity() : energy_after(way, p);
    if (!std::isfinite(energy)) return false;
    InertiaResponse end = inertia_.respond(e_.velocity + p);
    ++report_.solves;
    if (!end.failure.empty() || !end.gradient.allFinite()) return false;
    const double inertia = 0.5 * p.dot(gradient_towards(end) + end.gradient);
    if (inertia + energy - terms_.energy > sufficient_decrease * s * std::min(slope, 0.)) return false;
    at_ = std::move(way.end);
    pairs_ = std::move(way.near);
    e_ = std::move(end);
    return true;
  }

  double energy_after(const Walk<Dim>& way, const Eigen::VectorXd& step) const {
    const double contact = contact_energy<Dim>(scene_, interval_, way.end, way.near, friction_.points(), weights_);
    return potential_ ? contact + potential_->energy(e_.velocity + step) : contact;
  }

  void accept(Walk<Dim> way, const InertiaResponse& goal, double s) {
    at_ = std::move(way.end);
    pairs_ = std::move(way.near);
    e_.velocity = s == 1 ? goal.velocity : Eigen::VectorXd(e_.velocity + s * (goal.velocity - e_.velocity));
    const Eigen::VectorXd gradient = gradient_towards(goal);
    e_.gradient = s == 1 ? goal.gradient : Eigen::VectorXd(gradient + s * (goal.gradient - gradient));
    e_.constraint = goal.constraint;
  }

  ContactTerms terms_without_hessian(const std::vector<FrictionPoint<Dim>>& friction) const {
    return contact_terms<Dim>(scene_, interval_, at_, pairs_, friction, weights_, HessianProjection::exact, {});
  }

  bool stiffen() {
    terms_ = terms_without_hessian(friction_.points());
    if (terms_.tightest >= tiny_gap * weights_.reach) return false;
    weights_.stiffness *= stiffening;
    return true;
  }

  void finish() {
    const auto still = place<Dim>(scene_, interval_, velocities(Eigen::VectorXd::Zero(inertia_.size()), 0));
    report_.straight_share = walk<Dim>(scene_, interval_, still, at_.velocities, 0).share;
    report_.residual = e_.gradient + terms_.gradient;  // with the friction forces of the minimisation
    if (potential_) potential_->add_gradient(e_.velocity, report_.residual);
    const auto friction = friction_points<Dim>(scene_, at_, pairs_, weights_);
    terms_ = terms_without_hessian(friction);
    report_.velocity = e_.velocity;
    report_.gradient = e_.gradient;
    report_.active = terms_.active;
    report_.smallest_gap = terms_.smallest_gap;
    report_.stiffness = weights_.stiffness;
    report_.impulses = contact_impulses<Dim>(scene_, at_, pairs_, friction, weights_);
    report_.pairs = pair_impulses<Dim>(scene_, at_, pairs_, weights_);
  }

  const Scene<Dim>& scene_;
  InertiaProblem& inertia_;
  const ContactOptions& options_;
  const VelocityPotential* potential_;
  Interval<Dim> interval_;
  Weights weights_;
  ContactReport report_;
  // The present iterate: velocities and gradient of e, share of the prescribed motion, and the derived placement, pairs
  // and terms.
  InertiaResponse e_;
  Eigen::VectorXd guess_;          // of the stacked velocities, followed by begin()
  Eigen::VectorXd free_velocity_;  // without contact
  double share_ = 1;
  Placement<Dim> at_;
  std::vector<Candidate> pairs_;
  FrictionUpdates<Dim> friction_;
  ContactTerms terms_;
  double first_step_ = 0, last_step_ = 0;  // fastest points in Newton's first and last step with one friction, m/s
};

}  // namespace
}  // namespace contact

template <int Dim>
ContactReport solve_contact(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                            double dt, InertiaProblem& inertia, const ContactOptions& options,
                            const Eigen::VectorXd& start, const VelocityPotential* potential) {
  return contact::Solver<Dim>(scene, motions, horizon, dt, inertia, options, potential).run(start);
}

template ContactReport solve_contact<2>(const ContactScene<2>&, const std::vector<ContactMotion>&, double, double,
                                        InertiaProblem&, const ContactOptions&, const Eigen::VectorXd&,
                                        const VelocityPotential*);
template ContactReport solve_contact<3>(const ContactScene<3>&, const std::vector<ContactMotion>&, double, double,
                                        InertiaProblem&, const ContactOptions&, const Eigen::VectorXd&,
                                        const VelocityPotential*);

}  // namespace seiche
