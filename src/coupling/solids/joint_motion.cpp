#include "coupling/solids/joint_motion.h"

#include <algorithm>

#include "coupling/solids/coupled_step.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/solids/rigid_coupling.h"

namespace seiche {
namespace {

// Share of the size of a joint's body (1: a metre where it has none) within which a joint counts as closed.
constexpr double closed_share = 1e-10;

double gap_tolerance(const Joint& joint) {
  return closed_share * (joint.size > 0 ? joint.size : 1);
}

}  // namespace

template <int Dim>
JointMotion<Dim>::JointMotion(const JointSet<Dim>& joints, std::vector<PlacedRow> rows, const CoupledStep<Dim>& step,
                              const SolidCoupling<Dim>& coupling)
    : joints_(joints),
      rows_(std::move(rows)),
      state_(step.state),
      coupling_(coupling),
      dt_(step.dt),
      horizon_(step.horizon) {
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

// A leapfrog step goes on by its second half, and the next one begins with a half.
template <int Dim>
JointedBodies JointMotion<Dim>::bodies_after(const Eigen::VectorXd& v) const {
  const double half = state_.since_solve, after = state_.time - half + horizon_;
  JointedBodies bodies = jointed_bodies(state_.solids, after);
  for (std::size_t b = 0; b < coupling_.bodies.size(); ++b) {
    const auto k = std::size_t(coupling_.bodies[b]);
    const RigidState* r = state_.solids[k].rigid();
    if (!r) continue;
    const Body<Dim>& body = state_.solids[k].body();
    const Twist now = unstacked<Dim>(v, coupling_.first[b], r->center);
    const Vec3 free = unstacked<Dim>(coupling_.free, coupling_.first[b], r->center).angular;
    RigidState moved = led_by(body, *r, now, free, horizon_);
    if (half > 0) moved = gone_on(body, moved, moved, half);
    moved = advance(body, moved, horizon_ - half);
    bodies[k] = {rigid_pose(body, moved), moved.center};
  }
  return bodies;
}

template <int Dim>
Eigen::VectorXd JointMotion<Dim>::gaps(const Eigen::VectorXd& v) const {
  const std::vector<PlacedRow::Rate> rates = rates_of(coupling_, state_.solids, v);
  std::vector<double> near;
  for (std::size_t j = 0; j < joints_.list.size(); ++j) near.push_back(state_.joints[j].q);
  const JointedBodies now = jointed_bodies(state_.solids, state_.time - state_.since_solve);
  for (int j = 0; j < int(near.size()); ++j)
    if (has_coordinate(joints_, j))
      near[std::size_t(j)] += horizon_ * coordinate_of_joint(joints_, j, now, near[std::size_t(j)]).rate(rates);
  const auto after =
      constraints_of(joints_, state_.joints, bodies_after(v), near, state_.time - state_.since_solve + horizon_);
  Eigen::VectorXd c(Eigen::Index(after.size()));
  for (Eigen::Index i = 0; i < c.size(); ++i) c[i] = after[std::size_t(i)].value;
  return c;
}

template <int Dim>
Eigen::VectorXd JointMotion<Dim>::velocity_in_state() const {
  Eigen::VectorXd v(coupling_.size());
  for (std::size_t b = 0; b < coupling_.bodies.size(); ++b)
    v.segment(coupling_.first[b], coupling_.first[b + 1] - coupling_.first[b]) =
        state_.solids[std::size_t(coupling_.bodies[b])].velocity();
  return v;
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
  return joints_.names_of(open);
}

template <int Dim>
std::vector<PlacedRow::Rate> prescribed_rates(const Participants<Dim>& solids, double time, double span) {
  std::vector<PlacedRow::Rate> rates(solids.size() + 1, PlacedRow::Rate::Zero());
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k].body().is_prescribed()) continue;
    const Twist twist = solids[k].place(time, time + span, time).twist;
    rates[k] << twist.linear, twist.angular;
  }
  return rates;
}

template <int Dim>
std::vector<PlacedRow::Rate> rates_of(const SolidCoupling<Dim>& coupling, const Participants<Dim>& solids,
                                      const Eigen::VectorXd& v) {
  std::vector<PlacedRow::Rate> rates(solids.size() + 1, PlacedRow::Rate::Zero());
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
    if (!solids[std::size_t(coupling.bodies[b])].rigid()) continue;
    const Twist twist = unstacked<Dim>(v, coupling.first[b], Vec3::Zero());
    rates[std::size_t(coupling.bodies[b])] << twist.linear, twist.angular;
  }
  return rates;
}

template <int Dim>
void append_row(const PlacedRow& row, int number, const SolidCoupling<Dim>& coupling,
                std::vector<Eigen::Triplet<double>>& entries) {
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b)
    for (const auto& [solid, part] : row.parts) {
      if (solid != coupling.bodies[b]) continue;
      const int first = coupling.first[b];
      const auto own = stacked<Dim>(part.template head<3>(), part.template tail<3>());
      for (int i = 0; i < twist_size<Dim>; ++i)
        if (own[i] != 0 && !coupling.is_held(first + i)) entries.emplace_back(number, first + i, own[i]);
    }
}

#define SEICHE_INSTANTIATE(D)                                                                        \
  template std::vector<PlacedRow::Rate> prescribed_rates<D>(const Participants<D>&, double, double); \
  template class JointMotion<D>;                                                                     \
  template std::vector<PlacedRow::Rate> rates_of<D>(const SolidCoupling<D>&, const Participants<D>&, \
                                                    const Eigen::VectorXd&);                         \
  template void append_row<D>(const PlacedRow&, int, const SolidCoupling<D>&, std::vector<Eigen::Triplet<double>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
