#include "coupling/solids/joint_motion.h"

#include <algorithm>

#include "coupling/solids/coupled_step.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/solids/rigid_coupling.h"
#include "coupling/state/joint_messages.h"
#include "solid/rigid/motion.h"

namespace seiche {
namespace {

// Share of the size of a joint's body (1: a metre where it has none) within which a joint counts as closed.
constexpr double closed_share = 1e-10;

template <int Dim>
int first_unknown(const SolidCoupling<Dim>& coupling, int solid) {
  const auto found = std::lower_bound(coupling.bodies.begin(), coupling.bodies.end(), solid);
  return coupling.first[std::size_t(found - coupling.bodies.begin())];
}

double gap_tolerance(const Joint& joint) {
  return closed_share * (joint.size > 0 ? joint.size : 1);
}

// True for joints whose coordinates enter constraints: drives, and those that gears join.
template <int Dim>
std::vector<char> coordinates_in_rows(const JointSet<Dim>& joints) {
  std::vector<char> used(joints.list.size(), 0);
  for (std::size_t j = 0; j < used.size(); ++j) {
    const Joint& joint = joints.list[j];
    if (joint.drive) used[j] = 1;
    if (joint.spec.kind == JointKind::gear) used[std::size_t(joint.first)] = used[std::size_t(joint.second)] = 1;
  }
  return used;
}

// Place of r after `half`, the end of a leapfrog step, and `rest` of the next one. As gone_on() and advance() have it,
// without what these find twice: w is corrected by the free rotation of each part.
template <int Dim>
RigidState gone_on_twice(const Body<Dim>& body, const RigidState& r, double half, double rest) {
  RigidState next = half > 0 ? advance(body, r, half) : not_shown(r);
  if (rest <= 0) return next;
  if (Dim == 2 || half <= 0 || !turns_freely(body.spec().rigid)) return advance(body, next, rest);
  const PrincipalInertia inertia = principal_inertia(body.mass().inertia);
  const auto spin = [&](const RigidState& x, double dt) {
    return rotate_freely(inertia, x.rotation, r.angular_momentum, dt).mean_angular_velocity;
  };
  const Vec3 w = r.angular_velocity + spin(next, rest) - spin(r, r.horizon);
  next.center += rest * r.velocity;
  next.rotation = Eigen::Quaterniond(exp_rotation(rest * w) * next.rotation).normalized().toRotationMatrix();
  return next;
}

}  // namespace

template <int Dim>
JointMotion<Dim>::JointMotion(const JointSet<Dim>& joints, const CoupledStep<Dim>& step,
                              const SolidCoupling<Dim>& coupling)
    : joints_(joints), state_(step.state), coupling_(coupling), dt_(step.dt), horizon_(step.horizon) {
  const double time = state_.time - state_.since_solve;
  std::vector<double> near;
  for (const JointState& joint : state_.joints) near.push_back(joint.q);
  bodies_ = jointed_bodies(joints, state_.solids, time);
  rows_ = constraints_of(joints, state_.joints, bodies_, near, time);
  if (!joints.patches.empty()) lead_patches(near);
  rate.setZero(Eigen::Index(rows_.size()));
  impulse.setZero(rate.size());
  left.setZero(rate.size());
  given.setZero(rate.size());
  slack.setZero(rate.size());
  constexpr double share = 0.1;  // of what closes a joint
  for (std::size_t i = 0; i < rows_.size(); ++i)
    slack[Eigen::Index(i)] = share * gap_tolerance(joints_.list[std::size_t(rows_[i].joint)]) /
                             ((rows_[i].size > 0 ? rows_[i].size : 1) * horizon_);
}

template <int Dim>
void JointMotion<Dim>::lead_patches(const std::vector<double>& near) {
  JointedBodies after = bodies_after(velocity_in_state(), horizon_);
  const std::vector<PlacedRow> rows =
      constraints_of(joints_, state_.joints, after, near, state_.time - state_.since_solve + horizon_);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t n = 0; n < rows[i].parts.size(); ++n)
      if (rows[i].parts[n].first > joints_.solids) rows_[i].parts[n].second = rows[i].parts[n].second;
  for (std::size_t k = std::size_t(joints_.solids) + 1; k < after.size(); ++k)
    bodies_[k].rates = std::move(after[k].rates);
}

// A leapfrog step goes on by its second half, and the next one begins with a half. Elastic solids have none.
template <int Dim>
JointedBodies JointMotion<Dim>::bodies_after(const Eigen::VectorXd& v, double span) const {
  const double half = std::min(state_.since_solve, span), after = state_.time - state_.since_solve + span;
  JointedBodies bodies(state_.solids.size() + 1);
  for (std::size_t k = 0; k < state_.solids.size(); ++k) {
    PlacedBody& placed = bodies[k];
    placed.solid = int(k);
    const RigidState* r = state_.solids[k].rigid();
    if (!r) {
      placed.pose = state_.solids[k].place(after, after, after).pose;
      placed.about = placed.pose.pivot + placed.pose.displacement;
      continue;
    }
    const Body<Dim>& body = state_.solids[k].body();
    const int first = first_unknown(coupling_, int(k));
    const Twist now = unstacked<Dim>(v, first, r->center);
    const Vec3 free = unstacked<Dim>(coupling_.free, first, r->center).angular;
    const RigidState moved = gone_on_twice(body, led_by(body, *r, now, free, horizon_), half, span - half);
    placed.pose = rigid_pose(body, moved);
    placed.about = moved.center;
  }
  for (const HeldPatch<Dim>& held : joints_.patches) {
    const Eigen::VectorXd u = state_.solids[std::size_t(held.solid)].place(after, after, after).displacement;
    const int first = first_unknown(coupling_, held.solid);
    bodies.push_back(placed_patch<Dim>(held, u + span * v.segment(first, u.size())));
  }
  return bodies;
}

template <int Dim>
std::vector<PlacedRow> JointMotion<Dim>::rows_after(const JointedBodies& bodies, const Eigen::VectorXd& v,
                                                    double span) const {
  std::vector<double> near;
  for (std::size_t j = 0; j < joints_.list.size(); ++j) near.push_back(state_.joints[j].q);
  const std::vector<char> used = coordinates_in_rows(joints_);
  if (span > 0 && std::find(used.begin(), used.end(), 1) != used.end()) {
    const std::vector<PlacedRow::Rate> rates = rates_of(coupling_, bodies_, v);
    for (int j = 0; j < int(near.size()); ++j)
      if (used[std::size_t(j)])
        near[std::size_t(j)] += span * coordinate_of_joint(joints_, j, bodies_, near[std::size_t(j)]).rate(rates);
  }
  return constraints_of(joints_, state_.joints, bodies, near, state_.time - state_.since_solve + span);
}

template <int Dim>
Eigen::VectorXd JointMotion<Dim>::gaps(const Eigen::VectorXd& v) const {
  const std::vector<PlacedRow> after = rows_after(bodies_after(v, horizon_), v, horizon_);
  Eigen::VectorXd c(Eigen::Index(after.size()));
  for (Eigen::Index i = 0; i < c.size(); ++i) c[i] = after[std::size_t(i)].value;
  return c;
}

template <int Dim>
Eigen::VectorXd JointMotion<Dim>::velocity_in_state() const {
  return velocities_in(coupling_, state_);
}

template <int Dim>
double JointMotion<Dim>::excess(const Eigen::VectorXd& gaps) const {
  double most = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    most = std::max(most, std::abs(gaps[Eigen::Index(i)]) * rows_[i].size /
                              gap_tolerance(joints_.list[std::size_t(rows_[i].joint)]));
  return most;
}

template <int Dim>
double JointMotion<Dim>::largest_gap(const Eigen::VectorXd& gaps) const {
  double most = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) most = std::max(most, std::abs(gaps[Eigen::Index(i)]) * rows_[i].size);
  return most;
}

template <int Dim>
std::string JointMotion<Dim>::names_of_driven(const Eigen::VectorXd& parts) const {
  std::vector<int> driven;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (std::abs(parts[Eigen::Index(i)]) > 1e-6 * parts.cwiseAbs().maxCoeff()) driven.push_back(rows_[i].joint);
  return joints_.names_of(driven);
}

template <int Dim>
std::string JointMotion<Dim>::names_of_open(const Eigen::VectorXd& gaps) const {
  std::vector<int> open;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (std::abs(gaps[Eigen::Index(i)]) * rows_[i].size > gap_tolerance(joints_.list[std::size_t(rows_[i].joint)]))
      open.push_back(rows_[i].joint);
  return names_of_loops(joints_, state_, open);
}

template <int Dim>
std::vector<PlacedRow::Rate> prescribed_rates(const JointSet<Dim>& joints, const Participants<Dim>& solids, double time,
                                              double span) {
  std::vector<PlacedRow::Rate> rates(solids.size() + 1 + joints.patches.size(), PlacedRow::Rate::Zero());
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k].body().is_prescribed()) continue;
    const Twist twist = solids[k].place(time, time + span, time).twist;
    rates[k] << twist.linear, twist.angular;
  }
  return rates;
}

template <int Dim>
std::vector<PlacedRow::Rate> rates_of(const SolidCoupling<Dim>& coupling, const JointedBodies& bodies,
                                      const Eigen::VectorXd& v) {
  std::vector<PlacedRow::Rate> rates(bodies.size(), PlacedRow::Rate::Zero());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (bodies[k].rates.empty()) continue;
    const int first = first_unknown(coupling, bodies[k].solid);
    for (const auto& [i, rate] : bodies[k].rates) rates[k] += v[first + i] * rate;
  }
  return rates;
}

template <int Dim>
void append_row(const PlacedRow& row, int number, const JointedBodies& bodies, const SolidCoupling<Dim>& coupling,
                std::vector<Eigen::Triplet<double>>& entries) {
  for (const auto& [k, part] : row.parts) {
    const PlacedBody& body = bodies[std::size_t(k)];
    if (body.rates.empty()) continue;
    const int first = first_unknown(coupling, body.solid);
    for (const auto& [i, rate] : body.rates)
      if (const double own = part.dot(rate); own != 0 && !coupling.is_held(first + i))
        entries.emplace_back(number, first + i, own);
  }
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template std::vector<PlacedRow::Rate> prescribed_rates<D>(const JointSet<D>&, const Participants<D>&, double, \
                                                            double);                                            \
  template class JointMotion<D>;                                                                                \
  template std::vector<PlacedRow::Rate> rates_of<D>(const SolidCoupling<D>&, const JointedBodies&,              \
                                                    const Eigen::VectorXd&);                                    \
  template void append_row<D>(const PlacedRow&, int, const JointedBodies&, const SolidCoupling<D>&,             \
                              std::vector<Eigen::Triplet<double>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
