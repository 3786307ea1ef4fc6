#include "coupling/solids/joint_bow.h"

#include <algorithm>
#include <limits>

#include "base/disjoint_sets.h"
#include "coupling/solids/applied_forces.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/solids/rigid_coupling.h"
#include "solid/rigid/motion.h"

namespace seiche {
namespace {

using BowRate = PlacedRow::Rate;

// A body displaced by a small motion: a shift of its centre and a turn about it.
PlacedBody displaced_body(PlacedBody body, const BowRate& by) {
  body.pose.displacement += by.head<3>();
  body.about += by.head<3>();
  body.pose.rotation = exp_rotation(by.tail<3>()) * body.pose.rotation;
  return body;
}

JointedBodies displaced_bodies(JointedBodies bodies, const std::vector<BowRate>& by, double share) {
  for (std::size_t k = 0; k < bodies.size(); ++k)
    if (!by[k].isZero(0)) bodies[k] = displaced_body(std::move(bodies[k]), share * by[k]);
  return bodies;
}

// Inverse of a symmetric 3x3 matrix on the axes that are free; 0 on others, and on those without inertia.
Eigen::Matrix3d inverse_on(const Eigen::Matrix3d& inertia, const std::array<bool, 3>& fixed) {
  Eigen::Matrix3d kept = inertia;
  for (int a = 0; a < 3; ++a)
    if (fixed[std::size_t(a)]) kept.row(a).setZero(), kept.col(a).setZero();
  const PrincipalInertia principal = principal_inertia(kept);
  return principal.axes * principal.inverse_moments().asDiagonal() * principal.axes.transpose();
}

}  // namespace

template <int Dim>
JointBow<Dim>::JointBow(const JointSet<Dim>& joints, const CoupledStep<Dim>& step, const SolidCoupling<Dim>& coupling,
                        const JointMotion<Dim>& motion)
    : joints_(joints), step_(step), coupling_(coupling), motion_(motion) {
  impulse_.setZero(coupling.size());
  find_anchored();
  any_ = std::any_of(anchored_.begin(), anchored_.end(), [](char row) { return row != 0; });
  if (!any_) return;
  now_.resize(joints.list.size());
  end_.resize(joints.list.size());
  y_.setZero(Eigen::Index(anchored_.size()));
  delta_.assign(motion.bodies().size(), Rate::Zero());
  factor(motion_.rows(), inverse_masses(motion_.bodies()));
}

// delta = M^-1 C'y with the rows.
template <int Dim>
void JointBow<Dim>::set_displacements(const std::vector<PlacedRow>& rows) {
  delta_ = loads(rows, y_);
  for (std::size_t k = 0; k < delta_.size(); ++k) delta_[k] = inverse_[k] * delta_[k];
}

// Groups of rigid bodies, joined by rows; those that a row holds to what is prescribed.
template <int Dim>
void JointBow<Dim>::find_anchored() {
  const auto& solids = step_.state.solids;
  const std::vector<PlacedRow>& rows = motion_.rows();
  const auto moves = [&](int place) { return place < joints_.solids && solids[std::size_t(place)].rigid(); };
  const auto bends = [&](int place) {
    return place > joints_.solids ||
           (place < joints_.solids && solids[std::size_t(place)].unknowns() > 0 && !solids[std::size_t(place)].rigid());
  };
  DisjointSets groups(motion_.bodies().size());
  for (const PlacedRow& row : rows)
    for (const auto& [k, part] : row.parts)
      for (const auto& [other, unused] : row.parts)
        if (moves(k) && moves(other)) groups.join(k, other);
  std::vector<char> held(motion_.bodies().size(), 0), soft = held, wet = held;
  for (const PlacedRow& row : rows)
    for (const auto& [k, part] : row.parts)
      for (const auto& [other, unused] : row.parts)
        if (moves(k)) {
          const auto group = std::size_t(groups.root(k));
          wet[group] |= motion_.wet[std::size_t(k)];
          (bends(other) ? soft : held)[group] |= char(!moves(other));
        }
  for (const PlacedRow& row : rows) {
    const auto first = std::find_if(row.parts.begin(), row.parts.end(), [&](const auto& p) { return moves(p.first); });
    const bool any = first != row.parts.end();
    const auto group = std::size_t(any ? groups.root(first->first) : 0);
    anchored_.push_back(char(any && held[group] && !soft[group]));
    dry_.push_back(char(anchored_.back() && !wet[group]));
  }
}

// Inverse masses by the six motions of each place; 0 for held axes and what is prescribed.
template <int Dim>
std::vector<typename JointBow<Dim>::Inverse> JointBow<Dim>::inverse_masses(const JointedBodies& bodies) const {
  std::vector<Inverse> inverse(bodies.size(), Inverse::Zero());
  for (const int k : coupling_.bodies) {
    const Participant<Dim>& solid = step_.state.solids[std::size_t(k)];
    if (!solid.rigid()) continue;
    const RigidSpec& spec = solid.body().spec().rigid;
    const Eigen::Matrix3d& R = bodies[std::size_t(k)].pose.rotation;
    Inverse& own = inverse[std::size_t(k)];
    for (int a = 0; a < Dim; ++a) own(a, a) = spec.fixed_position[std::size_t(a)] ? 0 : 1 / solid.body().mass().mass;
    std::array<bool, 3> fixed = spec.fixed_rotation;
    if (Dim == 2) fixed[0] = fixed[1] = true;
    if (Dim == 3 && turns_freely(spec)) {
      const PrincipalInertia principal = principal_inertia(solid.body().mass().inertia);
      const Eigen::Matrix3d axes = R * principal.axes;
      own.template bottomRightCorner<3, 3>() = axes * principal.inverse_moments().asDiagonal() * axes.transpose();
      continue;
    }
    own.template bottomRightCorner<3, 3>() = inverse_on(R * solid.body().mass().inertia * R.transpose(), fixed);
  }
  return inverse;
}

// W of the rows.
template <int Dim>
void JointBow<Dim>::factor(const std::vector<PlacedRow>& placed, const std::vector<Inverse>& inverse) {
  std::vector<Eigen::Triplet<double>> rows, columns;
  for (std::size_t i = 0; i < anchored_.size(); ++i)
    for (const auto& [k, part] : placed[i].parts) {
      if (!anchored_[i]) continue;
      const Rate moved = inverse[std::size_t(k)] * part;
      for (int a = 0; a < 6; ++a) {
        if (moved[a] != 0) columns.emplace_back(6 * k + a, int(i), moved[a]);
        if (part[a] != 0) rows.emplace_back(int(i), 6 * k + a, part[a]);
      }
    }
  SparseMatrix C(Eigen::Index(anchored_.size()), 6 * Eigen::Index(inverse.size())), X(C.cols(), C.rows());
  C.setFromTriplets(rows.begin(), rows.end());
  X.setFromTriplets(columns.begin(), columns.end());
  constraints_ = ConstraintRows(C, std::move(X));
}

template <int Dim>
Eigen::VectorXd JointBow<Dim>::values(const std::vector<PlacedRow>& rows) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (anchored_[i]) c[Eigen::Index(i)] = rows[i].value;
  return c;
}

// C'y on each place.
template <int Dim>
std::vector<typename JointBow<Dim>::Rate> JointBow<Dim>::loads(const std::vector<PlacedRow>& rows,
                                                               const Eigen::VectorXd& y) const {
  std::vector<Rate> sums(delta_.size(), Rate::Zero());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const auto& [k, part] : rows[i].parts)
      if (anchored_[i]) sums[std::size_t(k)] += y[Eigen::Index(i)] * part;
  return sums;
}

// Fixed point of delta = M^-1 C'y at the displaced places and y <- y - W^+ c, with W where the solve stands; once gaps
// stop falling, where the bodies are. Starts from the y it ended with before.
template <int Dim>
bool JointBow<Dim>::close(const JointedBodies& middle, const Eigen::VectorXd& v, std::vector<PlacedRow>& rows) {
  constexpr int most_turns = 20;
  constexpr double slow = 0.5;
  inverse_ = inverse_masses(middle);
  double before = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < most_turns; ++turn) {
    rows = motion_.rows_after(displaced_bodies(middle, delta_, 1), v, motion_.horizon() / 2);
    const Eigen::VectorXd c = values(rows);
    const double excess = motion_.excess(c);
    if (turn > 1 && excess > slow * before) factor(rows, inverse_);
    if (excess > 1) y_ -= constraints_.multipliers(c);
    set_displacements(rows);
    if (excess <= 1) return true;
    before = excess;
  }
  return false;
}

namespace {

// The torque of one end's impulse: half of the middle's, as the free rotation between them carries it to first order in
// the interval `H`. turned: inertia^-1 torque; sign: 1 for its start, -1 for its end.
Vec3 carried_torque(const Vec3& torque, const Vec3& turned, const Eigen::Matrix3d& inertia, const Vec3& omega, double H,
                    double sign) {
  return torque +
         sign * H / 4 * (-omega.cross(torque) - Vec3(inertia * omega).cross(turned) + inertia * omega.cross(turned));
}

}  // namespace

template <int Dim>
void JointBow<Dim>::set_impulses(const JointedBodies& middle, const Eigen::VectorXd& v,
                                 const std::vector<PlacedRow>& rows) {
  const double H = motion_.horizon();
  const auto rates = rates_of(coupling_, motion_.bodies(), v);
  impulse_.setZero();
  load_.assign(now_.size(), Rate::Zero());
  std::vector<Vec3> points;
  const JointedBodies bowed = displaced_bodies(middle, delta_, 1);
  for (int j = 0; j < int(now_.size()); ++j) points.push_back(point_of_joint(joints_, j, bowed));
  for (std::vector<Eigen::VectorXd>* ends : {&now_, &end_})
    for (Eigen::VectorXd& own : *ends) own.setZero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!anchored_[i]) continue;
    const PlacedRow& row = rows[i];
    Eigen::VectorXd &now = now_[std::size_t(row.joint)], &end = end_[std::size_t(row.joint)];
    if (now.size() == 0) now.setZero(6 * Eigen::Index(row.parts.size())), end = now;
    for (std::size_t n = 0; n < row.parts.size(); ++n) {
      const auto k = std::size_t(row.parts[n].first);
      const Rate load = -8 / (3 * H) * y_[Eigen::Index(i)] * row.parts[n].second;
      Rate first = load, last = load;
      if (Dim == 3 && k < std::size_t(joints_.solids) && step_.state.solids[k].rigid() &&
          turns_freely(step_.state.solids[k].body().spec().rigid)) {
        const Eigen::Matrix3d& R = middle[k].pose.rotation;
        const Eigen::Matrix3d inertia = R * step_.state.solids[k].body().mass().inertia * R.transpose();
        const Vec3 omega = rates[k].template tail<3>(), torque = load.template tail<3>();
        const Vec3 turned = inverse_[k].template bottomRightCorner<3, 3>() * torque;
        first.template tail<3>() = carried_torque(torque, turned, inertia, omega, H, 1);
        last.template tail<3>() = carried_torque(torque, turned, inertia, omega, H, -1);
      }
      now.segment<6>(6 * Eigen::Index(n)) += first;
      end.segment<6>(6 * Eigen::Index(n)) += last;
      add_to_unknowns(k, first, impulse_);
      if (n > 0) continue;
      const Vec3 arm = bowed[k].about - points[std::size_t(row.joint)];
      load_[std::size_t(row.joint)] += load;
      load_[std::size_t(row.joint)].template tail<3>() += arm.cross(Vec3(load.template head<3>()));
    }
  }
}

template <int Dim>
void JointBow<Dim>::add_to_unknowns(std::size_t place, const Rate& load, Eigen::VectorXd& impulse) const {
  const auto found = std::lower_bound(coupling_.bodies.begin(), coupling_.bodies.end(), int(place));
  if (found == coupling_.bodies.end() || *found != int(place)) return;
  const int first = coupling_.first[std::size_t(found - coupling_.bodies.begin())];
  const auto own = stacked<Dim>(load.template head<3>(), load.template tail<3>());
  for (int i = 0; i < twist_size<Dim>; ++i)
    if (!coupling_.is_held(first + i)) impulse[first + i] += own[i];
}

// Bows that do not close, as near singular places of closed loops, are left out until the solve ends: turns that now
// take them and now do not would not end.
template <int Dim>
Eigen::VectorXd JointBow<Dim>::follow(const Eigen::VectorXd& v) {
  const Eigen::VectorXd before = impulse_;
  const JointedBodies middle = motion_.bodies_after(v, motion_.horizon() / 2);
  std::vector<PlacedRow> rows;
  if (fails_ || !close(middle, v, rows)) {
    fails_ = true;
    y_.setZero();
    std::fill(delta_.begin(), delta_.end(), Rate::Zero());
  }
  set_impulses(middle, v, rows);
  return impulse_ - before;
}

template <int Dim>
Eigen::VectorXd JointBow<Dim>::given() const {
  Eigen::VectorXd sum = impulse_by_forces();
  std::vector<char> seen(joints_.list.size(), 0);
  for (std::size_t i = 0; i < anchored_.size(); ++i) {
    const PlacedRow& row = motion_.rows()[i];
    const Eigen::VectorXd& bow = step_.state.joints[std::size_t(row.joint)].bow;
    if (!anchored_[i] || seen[std::size_t(row.joint)] || bow.size() != 6 * Eigen::Index(row.parts.size())) continue;
    seen[std::size_t(row.joint)] = 1;
    for (std::size_t n = 0; n < row.parts.size(); ++n)
      add_to_unknowns(std::size_t(row.parts[n].first), bow.segment<6>(6 * Eigen::Index(n)), sum);
  }
  return sum;
}

// Force and torque of the scene's fields and loads on each place, were the bodies displaced.
template <int Dim>
std::vector<typename JointBow<Dim>::Rate> JointBow<Dim>::forces_on(const JointedBodies& bodies) const {
  std::vector<Rate> sums(bodies.size(), Rate::Zero());
  if (step_.setup.forces.empty()) return sums;
  for (std::size_t i = 0; i < dry_.size(); ++i)
    for (const auto& [k, part] : motion_.rows()[i].parts)
      if (dry_[i] && k < joints_.solids && step_.state.solids[std::size_t(k)].rigid())
        sums[std::size_t(k)] = steady_load(step_.setup.forces, step_.state.solids[std::size_t(k)],
                                           bodies[std::size_t(k)].pose, step_.state.time - 0.5 * step_.dt);
  return sums;
}

// (H^3 + H_before^3)/48 grad |a|^2 with a = f - M^-1 C'y, C a = 0, f of gravity, fields and loads. With all but the
// places of the bodies held the gradient is 2 M df along a - 2 y'dC a, and second derivatives of gaps commute:
// -2 (dC along a)'y.
template <int Dim>
Eigen::VectorXd JointBow<Dim>::impulse_by_forces() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(coupling_.size());
  if (std::find(dry_.begin(), dry_.end(), 1) == dry_.end()) return sum;
  const std::vector<Inverse> inverse = inverse_masses(motion_.bodies());
  std::vector<Rate> a = free_accelerations(inverse);
  Eigen::VectorXd Ca = Eigen::VectorXd::Zero(y_.size());
  for (std::size_t i = 0; i < dry_.size(); ++i)
    for (const auto& [k, part] : motion_.rows()[i].parts)
      if (dry_[i]) Ca[Eigen::Index(i)] += part.dot(a[std::size_t(k)]);
  const Eigen::VectorXd y = constraints_.multipliers(Ca);
  const std::vector<Rate> load = loads(motion_.rows(), y);
  double fastest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    a[k] -= inverse[k] * load[k];
    const double size = k < step_.state.solids.size() ? step_.state.solids[k].body().radius() : 1;
    fastest =
        std::max(fastest, a[k].template tail<3>().norm() + (size > 0 ? a[k].template head<3>().norm() / size : 0));
  }
  if (fastest > 0) add_changes(a, 1e-5 / fastest, y, sum);
  return sum;
}

// Accelerations by gravity, fields and loads alone.
template <int Dim>
std::vector<typename JointBow<Dim>::Rate> JointBow<Dim>::free_accelerations(const std::vector<Inverse>& inverse) const {
  const Vec3 g = step_.setup.fluids.gravity.of_step(step_.state.time, step_.dt);
  const std::vector<Rate> forces = forces_on(motion_.bodies());
  std::vector<Rate> a(delta_.size(), Rate::Zero());
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (int i = 0; i < Dim; ++i)
      if (inverse[k](i, i) > 0) a[k][i] = g[i];
    if (!forces[k].isZero(0)) a[k] += inverse[k] * forces[k];
  }
  return a;
}

// Adds (H^3 + H_before^3)/24 (M df - (dC)'y), the changes over bodies displaced by `way` a, by central differences.
template <int Dim>
void JointBow<Dim>::add_changes(const std::vector<Rate>& a, double way, const Eigen::VectorXd& y,
                                Eigen::VectorXd& sum) const {
  const auto weight = [&](std::size_t row) {
    const double before = step_.state.joints[std::size_t(motion_.rows()[row].joint)].interval;
    return (std::pow(motion_.horizon(), 3) + std::pow(before, 3)) / (48 * way);
  };
  const Eigen::VectorXd still = motion_.velocity_in_state();
  const JointedBodies there = displaced_bodies(motion_.bodies(), a, way),
                      back = displaced_bodies(motion_.bodies(), a, -way);
  const auto ahead = motion_.rows_after(there, still, 0), behind = motion_.rows_after(back, still, 0);
  std::vector<double> of_body(a.size(), 0);
  for (std::size_t i = 0; i < dry_.size(); ++i) {
    if (!dry_[i]) continue;
    for (std::size_t n = 0; n < ahead[i].parts.size(); ++n) {
      const auto k = std::size_t(ahead[i].parts[n].first);
      of_body[k] = weight(i);
      add_to_unknowns(k, -weight(i) * y[Eigen::Index(i)] * (ahead[i].parts[n].second - behind[i].parts[n].second), sum);
    }
  }
  const std::vector<Rate> forces = forces_on(there), before = forces_on(back);
  for (std::size_t k = 0; k < a.size(); ++k)
    if (forces[k] != before[k]) add_to_unknowns(k, of_body[k] * (forces[k] - before[k]), sum);
}

template <int Dim>
void JointBow<Dim>::take(int j, JointState& state) const {
  const auto first = std::find_if(motion_.rows().begin(), motion_.rows().end(), [&](auto& r) { return r.joint == j; });
  if (!any_ || first == motion_.rows().end() || now_[std::size_t(j)].size() == 0) {
    for (Eigen::VectorXd* own : {&state.bow, &state.bow_rows, &state.bow_load}) own->resize(0);
    return;
  }
  const Rate& own = load_[std::size_t(j)];
  const Rate load = state.bow_load.size() == 6 ? Rate(own + state.bow_load) : own;
  state.force += load.template head<3>() / motion_.dt();
  state.torque += load.template tail<3>() / motion_.dt();
  state.bow = end_[std::size_t(j)];
  state.bow_load = own;
  take_rows(std::size_t(first - motion_.rows().begin()), state);
}

// Multipliers of the joint's rows, of which the first is `begin`, and the power of drives by them.
template <int Dim>
void JointBow<Dim>::take_rows(std::size_t begin, JointState& state) const {
  std::size_t end = begin;
  while (end < motion_.rows().size() && motion_.rows()[end].joint == motion_.rows()[begin].joint) ++end;
  const auto n = Eigen::Index(end - begin);
  const Eigen::VectorXd rows = -8 / (3 * motion_.horizon()) * y_.segment(Eigen::Index(begin), n);
  const Eigen::VectorXd both = state.bow_rows.size() == n ? Eigen::VectorXd(rows + state.bow_rows) : rows;
  state.power += both.dot(motion_.given.segment(Eigen::Index(begin), n)) / motion_.dt();
  state.bow_rows = rows;
}

template <int Dim>
Eigen::VectorXd push_with_bow(const SolidCoupling<Dim>& c) {
  return c.joints && c.joints->bow ? Eigen::VectorXd(c.push + c.joints->bow->impulse()) : c.push;
}

#define SEICHE_INSTANTIATE(D) \
  template class JointBow<D>; \
  template Eigen::VectorXd push_with_bow<D>(const SolidCoupling<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
