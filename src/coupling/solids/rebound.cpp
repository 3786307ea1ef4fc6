#include "coupling/solids/rebound.h"

#include <algorithm>
#include <map>
#include <optional>

#include "base/scene.h"
#include "coupling/solids/coupled_step.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"

namespace seiche {
namespace {

// Solids that meet more slowly stay together: speeds that this many steps of gravity make, and this share of the speed
// of a fall through one cell.
constexpr double steps_of_gravity = 2, share_of_fall = 0.01;
// Share of the speed of approach below which solids count as at rest against each other.
constexpr double at_rest = 0.05;

using SolidPair = std::array<int, 2>;

// Motion of solid k, over the interval if it is prescribed. Sides of the domain (k < 0) are at rest.
template <int Dim>
Twist motion_over(const State<Dim>& state, int k, double from, double to) {
  if (k < 0) return {};
  const Participant<Dim>& solid = state.solids[std::size_t(k)];
  Placement placed = solid.place(from, to, to);
  solid.set_velocity(placed);
  return placed.twist;
}

using Impulses = std::vector<Impact::Impulse>;

// True for rebounds that were part of the last solve.
bool has_acted(const Impact& impact) {
  return impact.approach == 0;
}

Vec3 normal_of(const Impulses& impulses) {
  Vec3 sum = Vec3::Zero();
  for (const Impact::Impulse& i : impulses) sum += i.linear;
  return sum.stableNormalized();
}

// Mean of the places, weighted by the impulses.
Vec3 place_of(const Impulses& impulses) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const Impact::Impulse& i : impulses) {
    sum += i.linear.norm() * i.point;
    weight += i.linear.norm();
  }
  return sum / weight;
}

template <int Dim>
class ImpactSearch {
 public:
  ImpactSearch(const Setup<Dim>& setup, const State<Dim>& before, const State<Dim>& after, double dt)
      : setup_(setup),
        before_(before),
        after_(after),
        dt_(dt),
        gravity_(setup.fluids.gravity.of_step(after.time, dt)) {}

  Impacts run(const std::vector<PairImpulse>& pairs) const {
    std::map<SolidPair, Impulses> pushes;
    for (const PairImpulse& one : pairs)
      if (coefficient(one.first, one.second) && !one.linear.isZero(0))
        pushes[{one.first, one.second}].push_back({one.point, one.linear});
    Impacts impacts;
    for (const Impact& earlier : before_.impacts)
      if (!has_acted(earlier)) impacts.push_back(earlier.is_due ? acted(earlier) : gone_on(earlier, pushes));
    for (const auto& [pair, push] : pushes) {
      const double speed = approach(before_, pair, push, before_.time - dt_);
      if (speed > least_approach()) impacts.push_back(begun(pair, push, speed));
    }
    return impacts;
  }

 private:
  std::optional<double> coefficient(int a, int b) const {
    const PairFrictions& all = setup_.solids.restitutions;
    const auto found = all.find(b < 0 ? SolidPair{a, -1} : SolidPair{std::min(a, b), std::max(a, b)});
    return found == all.end() ? std::nullopt : std::optional(found->second);
  }

  // Speed at which the pair approaches where contact acts, m/s. Prescribed solids: mean of the step from a time.
  double approach(const State<Dim>& state, const SolidPair& p, const Impulses& push, double from) const {
    const Vec3 x = place_of(push);
    const Twist one = motion_over(state, p[0], from, from + dt_), two = motion_over(state, p[1], from, from + dt_);
    return normal_of(push).dot(two.at(x) - one.at(x));
  }

  // Weight of a solid over its mass, less that of liquid in its place where there is any, m/s^2.
  Vec3 fall_of(int k) const {
    if (k < 0 || !setup_.solids.bodies[std::size_t(k)].is_free()) return Vec3::Zero();
    const MassProperties& body = setup_.solids.bodies[std::size_t(k)].mass();
    const LiquidSpec& liquid = setup_.scene->liquid;
    const bool is_dry = liquid.regions.empty() && liquid.sources.empty();
    const double borne = is_dry ? 0 : setup_.fluids.density() * body.volume / body.mass;
    return std::max(0.0, 1 - borne) * gravity_;
  }

  // Speed that gravity adds to the approach in the step, m/s.
  double driven(const Impact& impact, const Impulses& push) const {
    return std::max(0.0, dt_ * normal_of(push).dot(fall_of(impact.second) - fall_of(impact.first)));
  }

  double least_approach() const {
    const double g = gravity_.norm();
    return steps_of_gravity * g * dt_ + share_of_fall * std::sqrt(g * setup_.domain.layout.h());
  }

  // Velocities belong to the middle of the step before: gravity adds half of what it does in a step.
  Impact begun(const SolidPair& pair, const Impulses& push, double speed) const {
    Impact impact{pair[0], pair[1], speed, 0, false, {}};
    raise(speed + 0.5 * driven(impact, push), impact);
    return with(push, impact);
  }

  // The impact after the solve, with its push, which is taken out of the list. Solids that part rebound.
  Impact gone_on(Impact impact, std::map<SolidPair, Impulses>& pushes) const {
    carry(impact);
    const auto found = pushes.find({impact.first, impact.second});
    if (found == pushes.end()) return finished(std::move(impact));
    const Impulses push = std::move(found->second);
    pushes.erase(found);
    return with(push, std::move(impact));
  }

  static Impact acted(Impact impact) {
    impact.approach = 0;
    return impact;
  }

  // Moves the places of the impulses with the solids.
  void carry(Impact& impact) const {
    const double t = before_.time;
    const Twist one = motion_over(before_, impact.first, t, t + dt_),
                two = motion_over(before_, impact.second, t, t + dt_);
    for (Impact::Impulse& i : impact.impulses) i.point += 0.5 * dt_ * (one.at(i.point) + two.at(i.point));
  }

  // Both together stay the speed that contact takes.
  static void raise(double approach, Impact& impact) {
    impact.driven -= approach - impact.approach;
    impact.approach = approach;
  }

  // Gravity works on the way that is left until the solids touch: a^2 + 2 g s.
  Impact with(const Impulses& push, Impact impact) const {
    const double by_gravity = driven(impact, push);
    impact.impulses.insert(impact.impulses.end(), push.begin(), push.end());
    impact.driven += by_gravity;
    const double rest = left(impact);
    raise(std::sqrt(impact.approach * impact.approach + 2 * by_gravity * std::max(0.0, rest)), impact);
    return rest <= at_rest * impact.approach ? finished(std::move(impact)) : impact;
  }

  double left(const Impact& impact) const {
    return approach(after_, {impact.first, impact.second}, impact.impulses, after_.time);
  }

  // Contact has taken the speed of approach a and what gravity added to it, d, but for a rest r (below 0: the barrier
  // has pushed the solids apart). The speed of rebound shall be e a, before half a step of gravity, d':
  //   share = (e a + r + d')/(a + d - r).
  Impact finished(Impact impact) const {
    const double rest = left(impact), taken = impact.approach + impact.driven - rest;
    const double e = *coefficient(impact.first, impact.second),
                 wanted = e * impact.approach + rest + 0.5 * driven(impact, impact.impulses);
    for (Impact::Impulse& i : impact.impulses) i.linear *= wanted / taken;
    impact.is_due = true;
    return impact;
  }

  const Setup<Dim>& setup_;
  const State<Dim>&before_, &after_;
  double dt_;
  Vec3 gravity_;
};

template <int Dim>
class Rebounds : public Interaction<Dim> {
 public:
  void add_forces(const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) const override {
    for (const Impact& impact : step.state.impacts) {
      if (!impact.is_due || has_acted(impact)) continue;
      push(step.state, impact, impact.first, 1, parts.coupling);
      push(step.state, impact, impact.second, -1, parts.coupling);
    }
  }

  // The solids were at rest against each other before: half the impulse times the velocity found.
  double driven_work(const State<Dim>& state, double dt) const override {
    double work = 0;
    for (const Impact& impact : state.impacts) {
      if (!has_acted(impact)) continue;
      const Twist one = motion_over(state, impact.first, state.time, state.time + dt),
                  two = motion_over(state, impact.second, state.time, state.time + dt);
      for (const Impact::Impulse& i : impact.impulses) work += 0.5 * i.linear.dot(one.at(i.point) - two.at(i.point));
    }
    return work;
  }

 private:
  static void push(const State<Dim>& state, const Impact& impact, int k, double sign, SolidCoupling<Dim>& c) {
    const auto block = std::find(c.bodies.begin(), c.bodies.end(), k);
    if (block == c.bodies.end() || !state.solids[std::size_t(k)].rigid()) return;
    const Participant<Dim>& solid = state.solids[std::size_t(k)];
    BodyImpulse sum;
    for (const Impact::Impulse& i : impact.impulses) {
      sum.linear += sign * i.linear;
      sum.angular += sign * (i.point - solid.rigid()->center).cross(i.linear);
    }
    const Eigen::VectorXd all = solid.generalised(sum);
    const int first = c.first[std::size_t(block - c.bodies.begin())];
    for (Eigen::Index i = 0; i < all.size(); ++i)
      if (!c.is_held(first + i)) c.push[first + i] += all[i];
  }
};

}  // namespace

template <int Dim>
Impacts impacts_after(const Setup<Dim>& setup, const State<Dim>& before, const State<Dim>& after,
                      const std::vector<PairImpulse>& pairs, double dt) {
  if (setup.solids.restitutions.empty()) return {};
  return ImpactSearch<Dim>(setup, before, after, dt).run(pairs);
}

template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_rebounds() {
  return std::make_unique<Rebounds<Dim>>();
}

#define SEICHE_INSTANTIATE(D)                                                          \
  template Impacts impacts_after<D>(const Setup<D>&, const State<D>&, const State<D>&, \
                                    const std::vector<PairImpulse>&, double);          \
  template std::unique_ptr<const Interaction<D>> make_rebounds<D>();
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
