#include "coupling/solids/impact_search.h"

#include <algorithm>

#include "base/restitution.h"
#include "base/scene.h"
#include "coupling/solids/rigid_coupling.h"
#include "coupling/state/solids.h"
#include "linalg/core/dense_factors.h"
#include "solid/contact/reflections.h"

namespace seiche {
namespace {

// Solids that meet more slowly stay together: speeds that forces make in this many steps, and this share of the speed
// of a fall through one cell.
constexpr double steps_of_forces = 2, share_of_fall = 0.01;
// Share of the speed of approach below which solids count as at rest against each other, and the most solves until
// they rebound whatever is left of it.
constexpr double left_at_rest = 0.05;
constexpr int most_solves = 4;
// Corrections of a rebound while contact still pushes, and the share of its speed that is left uncorrected.
constexpr int most_corrections = 30;
constexpr double uncorrected = 1e-3;
// Share of the mean diagonal of W'M^-1 W that keeps corrections small where pairs depend on each other.
constexpr double damping = 0.01;

bool is_under_way(const Impact& impact) {
  return impact.stage == Impact::Stage::meeting;
}

}  // namespace

template <int Dim>
std::vector<Impacts> clusters_of(const Impacts& impacts, const ImpactColumns<Dim>& columns) {
  std::vector<int> group(impacts.size());
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = int(i);
  const auto shared = [&](int a, int b) { return columns.moves_with(a, b); };
  for (std::size_t i = 0; i < impacts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Impact &a = impacts[i], &b = impacts[j];
      if (group[i] == group[j] || !(shared(a.first, b.first) || shared(a.first, b.second) ||
                                    shared(a.second, b.first) || shared(a.second, b.second)))
        continue;
      const int from = std::max(group[i], group[j]), to = std::min(group[i], group[j]);
      std::replace(group.begin(), group.end(), from, to);
    }
  std::map<int, Impacts> all;
  for (std::size_t i = 0; i < impacts.size(); ++i) all[group[i]].push_back(impacts[i]);
  std::vector<Impacts> clusters;
  for (auto& [first, cluster] : all) clusters.push_back(std::move(cluster));
  return clusters;
}

template <int Dim>
Impacts ImpactSearch<Dim>::run(const std::vector<PairImpulse>& pairs) const {
  Pushes pushes = pushes_of(pairs);
  Impacts under_way, all, rebounds;
  for (const Impact& earlier : state_.impacts)
    if (earlier.stage == Impact::Stage::due)
      rebounds.push_back(rebounded(earlier, pushes.contains({earlier.first, earlier.second})));
  for (const Impact& earlier : state_.impacts) {
    if (!is_under_way(earlier)) continue;
    under_way.push_back(earlier);
    Push push;
    if (const auto found = pushes.find({earlier.first, earlier.second}); found != pushes.end()) {
      push = std::move(found->second);
      pushes.erase(found);
    }
    go_on(push, under_way.back());
  }
  begin(std::move(pushes), under_way);
  for (Impacts& cluster : clusters_of(under_way, columns_)) {
    if (is_over(cluster)) set_rebounds(cluster);
    all.insert(all.end(), cluster.begin(), cluster.end());
  }
  const auto meets_again = [&](const Impact& i) {
    return std::any_of(under_way.begin(), under_way.end(),
                       [&](const Impact& other) { return other.first == i.first && other.second == i.second; });
  };
  for (Impact& impact : rebounds) {
    if (meets_again(impact)) impact.stage = Impact::Stage::acted, impact.impulses.clear();
    all.push_back(std::move(impact));
  }
  return all;
}

// 0 without a [[contact]] of the pair. Nothing where one of them cannot rebound.
template <int Dim>
std::optional<double> ImpactSearch<Dim>::coefficient(int a, int b) const {
  for (const int k : {a, b})
    if (k >= 0 && !may_rebound(setup_.scene->solids[std::size_t(k)].kind)) return {};
  const PairCoefficients& all = setup_.solids.restitutions;
  const auto found = all.find(b < 0 ? SolidPair{a, -1} : SolidPair{std::min(a, b), std::max(a, b)});
  return found == all.end() ? 0 : found->second;
}

// Contact acts where the solids will be at the end of the horizon.
template <int Dim>
typename ImpactSearch<Dim>::Pushes ImpactSearch<Dim>::pushes_of(const std::vector<PairImpulse>& pairs) const {
  const auto arm = [&](int k, const Vec3& x) -> Vec3 {
    const auto center = columns_.center(k);
    if (!center) return Vec3::Zero();
    const Eigen::VectorXd own = v_.after.segment(columns_.first_unknown(k), twist_size<Dim>);
    return x - *center - horizon_ * unstacked<Dim>(own, 0, *center).linear;
  };
  Pushes pushes;
  for (const PairImpulse& one : pairs)
    if (coefficient(one.first, one.second) && !one.linear.isZero(0))
      pushes[{one.first, one.second}].push_back({arm(one.first, one.point), arm(one.second, one.point), one.linear});
  return pushes;
}

// Speed that forces and liquid add to the approach in the step, m/s.
template <int Dim>
double ImpactSearch<Dim>::driven(const ImpactColumn& column) const {
  return std::max(0.0, column.parting(v_.before) - column.parting(v_.alone));
}

template <int Dim>
double ImpactSearch<Dim>::least_approach(const ImpactColumn& column) const {
  const Eigen::VectorXd change = v_.alone - v_.before;
  const double fastest =
      std::max(columns_.change_at(column, 0, change).norm(), columns_.change_at(column, 1, change).norm());
  return steps_of_forces * fastest + share_of_fall * std::sqrt(fastest / dt_ * setup_.domain.layout.h());
}

// Contact takes -Lambda u of energy, with u the mean of the speeds of parting before the solve, rebounds included, and
// after it. On the way s that is left until the solids touch, forces drive them on: a^2 + 2 g s.
template <int Dim>
void ImpactSearch<Dim>::go_on(const Push& push, Impact& impact) const {
  ++impact.solves;
  if (push.empty()) return;
  const ImpactColumn now = columns_.column(impact.first, impact.second, push);
  const double rebounds = now.parting(v_.free) - now.parting(v_.alone);
  impact.energy -= 0.5 * now.size * (now.parting(v_.before) + rebounds + now.parting(v_.after));
  impact.impulses.insert(impact.impulses.end(), push.begin(), push.end());
  const ImpactColumn all = column_of(impact);
  const double left = std::max(0.0, -all.parting(v_.after)), a = impact.approach;
  if (a > 0) impact.approach = std::sqrt(a * a + 2 * driven(all) * left);
}

// Velocities belong to the middle of the step before: forces add half of what they do in a step. The speed is that
// before impacts nearby have changed it.
template <int Dim>
Impact ImpactSearch<Dim>::begun(const SolidPair& pair, const Push& push) const {
  Impact impact;
  impact.first = pair[0], impact.second = pair[1];
  const ImpactColumn column = columns_.column(pair[0], pair[1], push);
  impact.approach = -column.parting(v_.free) - 0.5 * driven(column);
  for (const Impact& other : state_.impacts) {
    if (!is_under_way(other)) continue;
    const ImpactColumn its = column_of(other);
    impact.approach += columns_.product(column, its) * its.size;
  }
  go_on(push, impact);
  return impact;
}

template <int Dim>
bool ImpactSearch<Dim>::is_fast(const SolidPair& pair, const Push& push) const {
  if (!(coefficient(pair[0], pair[1]) > 0)) return false;
  const ImpactColumn column = columns_.column(pair[0], pair[1], push);
  return -column.parting(v_.free) - driven(column) > least_approach(column);
}

template <int Dim>
bool ImpactSearch<Dim>::touches(const SolidPair& pair, const Impacts& impacts) const {
  const auto is_shared = [&](int k, const Impact& i) {
    return columns_.moves_with(k, i.first) || columns_.moves_with(k, i.second);
  };
  return std::any_of(impacts.begin(), impacts.end(),
                     [&](const Impact& i) { return is_shared(pair[0], i) || is_shared(pair[1], i); });
}

// Pairs that meet fast enough begin, unless they are to stay together. Pairs that touch their solids join, however slow
// and whatever their coefficient: they pass impacts on.
template <int Dim>
void ImpactSearch<Dim>::begin(Pushes pushes, Impacts& impacts) const {
  const auto add_all = [&](const auto& fits) {
    bool any = false;
    for (auto one = pushes.begin(); one != pushes.end();) {
      const bool is_new = fits(one->first, one->second);
      if (is_new) impacts.push_back(begun(one->first, one->second));
      any = any || is_new;
      one = is_new ? pushes.erase(one) : std::next(one);
    }
    return any;
  };
  add_all([&](const SolidPair& pair, const Push& push) { return is_fast(pair, push); });
  while (add_all([&](const SolidPair& pair, const Push&) { return touches(pair, impacts); })) {
  }
}

// True if no pair of the cluster still approaches by more than a trace of the fastest impact.
template <int Dim>
bool ImpactSearch<Dim>::is_over(const Impacts& cluster) const {
  double fastest = 0, left = 0;
  int solves = 0;
  for (const Impact& impact : cluster) {
    fastest = std::max(fastest, impact.approach);
    left = std::max(left, -column_of(impact).parting(v_.after));
    solves = std::max(solves, impact.solves);
  }
  return left <= left_at_rest * fastest || solves >= most_solves;
}

// The pairs shall part at the speeds u of rebounds one after the other, before half a step of forces d:
//   A J = u - w_now + d/2, J near the impulses of these rebounds less those of an inelastic impact.
template <int Dim>
void ImpactSearch<Dim>::set_rebounds(Impacts& cluster) const {
  const auto n = Eigen::Index(cluster.size());
  std::vector<ImpactColumn> columns;
  Eigen::VectorXd w(n), e(n), now(n), forces(n), most(n);
  double energy = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    Impact& impact = cluster[std::size_t(i)];
    const ImpactColumn& column = columns.emplace_back(column_of(impact));
    w[i] = -impact.approach, e[i] = *coefficient(impact.first, impact.second);
    now[i] = column.parting(v_.after), forces[i] = driven(column), most[i] = column.size;
    if (impact.energy > 0) impact.energy *= e[i] * e[i];
    energy += impact.energy;
  }
  Eigen::MatrixXd A = columns_.products(columns), damped = A;
  damped.diagonal().array() += damping * A.trace() / double(n);
  const Eigen::VectorXd l = rebound_impulses(A, w, e), target = w + A * l - now + 0.5 * forces;
  Eigen::VectorXd J = l - stopping_impulses(A, w);
  J = (J + DenseLdlt(damped).solve(target - A * J)).cwiseMax(-most);
  J *= std::min(1.0, share_within(J.dot(now - 0.5 * forces), J.dot(A * J), energy));
  const Eigen::VectorXd made = A * J;
  for (Eigen::Index i = 0; i < n; ++i) {
    Impact& impact = cluster[std::size_t(i)];
    impact.stage = Impact::Stage::due;
    impact.solves = 0;
    impact.approach = forces[i] - now[i] - made[i];
    impact.share = J[i] / most[i];
    impact.response = J[i] * made[i];
  }
}

// Contact returns what it has stored over some steps where these are short. While it pushes the pair, the next solve
// takes back by how much they part faster than the rebound is to be.
template <int Dim>
Impact ImpactSearch<Dim>::rebounded(const Impact& earlier, bool is_pushed) const {
  Impact impact;
  impact.first = earlier.first, impact.second = earlier.second;
  impact.stage = Impact::Stage::acted;
  if (!is_pushed || earlier.solves >= most_corrections) return impact;
  const ImpactColumn column = column_of(earlier);
  const double excess = column.parting(v_.after) + earlier.approach, response = columns_.product(column, column);
  impact.stage = Impact::Stage::due;
  impact.solves = earlier.solves + 1;
  impact.approach = earlier.approach + driven(column);
  impact.impulses = earlier.impulses;
  if (excess <= uncorrected * std::abs(earlier.approach) || response <= 0) return impact;
  impact.share = -excess / (response * column.size);
  impact.response = excess * excess / response;
  return impact;
}

#define SEICHE_INSTANTIATE(D)                                                            \
  template std::vector<Impacts> clusters_of<D>(const Impacts&, const ImpactColumns<D>&); \
  template class ImpactSearch<D>;
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
