#include "coupling/solids/impact_columns.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "coupling/solids/joint_motion.h"
#include "coupling/solids/rigid_coupling.h"
#include "linalg/core/dense_factors.h"
#include "solid/rigid/state.h"

namespace seiche {
namespace {

// Mean velocity of a prescribed solid over the coming interval. Sides of the domain (k < 0) are at rest.
template <int Dim>
Twist prescribed_motion(const State<Dim>& state, int k, double horizon) {
  if (k < 0) return {};
  const double t = state.time;
  return state.solids[std::size_t(k)].place(t, t + horizon, t + horizon).twist;
}

// The smallest block that each block is linked to by rows of C.
template <int Dim>
std::vector<int> linked_blocks(const SolidCoupling<Dim>& coupling) {
  DisjointSets sets(coupling.bodies.size());
  std::vector<int> seen(std::size_t(coupling.J.constraints.rows()), -1);  // by row: a block in it
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b)
    for (int i = coupling.first[b]; i < coupling.first[b + 1]; ++i)
      for (SparseMatrix::InnerIterator entry(coupling.J.constraints, i); entry; ++entry) {
        int& other = seen[std::size_t(entry.row())];
        if (other < 0) other = int(b);
        sets.join(other, int(b));
      }
  std::vector<int> group(coupling.bodies.size());
  for (std::size_t b = 0; b < group.size(); ++b) group[b] = sets.root(int(b));
  return group;
}

}  // namespace

double ImpactColumn::dot(const Eigen::VectorXd& v) const {
  double speed = 0;
  for (std::size_t s : {0, 1})
    if (first_unknown[s] >= 0) speed += part[s].dot(v.segment(first_unknown[s], part[s].size()));
  return speed;
}

void ImpactColumn::add_to(Eigen::VectorXd& push, double impulse) const {
  for (std::size_t s : {0, 1})
    if (first_unknown[s] >= 0) push.segment(first_unknown[s], part[s].size()) += impulse * part[s];
}

template <int Dim>
std::shared_ptr<const BodyMatrix> jointed_inertia(const SolidCoupling<Dim>& coupling, const Communicator& ranks) {
  if (!coupling.is_constrained()) return nullptr;
  if (coupling.joints->inertia) return coupling.joints->inertia;
  SparseMatrix M = coupling.mass;
  M.prune(
      [&](Eigen::Index i, Eigen::Index j, double) { return i == j || (!coupling.is_held(i) && !coupling.is_held(j)); });
  auto jointed = std::make_shared<BodyMatrix>(ranks);
  return jointed->set(std::move(M), coupling.J.constraints) ? jointed : nullptr;
}

template <int Dim>
ImpactColumns<Dim>::ImpactColumns(const State<Dim>& state, const SolidCoupling<Dim>& coupling,
                                  std::shared_ptr<const BodyMatrix> jointed, double horizon)
    : state_(state), coupling_(coupling), jointed_(std::move(jointed)), horizon_(horizon) {
  if (coupling.is_constrained()) group_ = linked_blocks(coupling);
}

template <int Dim>
bool ImpactColumns<Dim>::moves_with(int a, int b) const {
  if (!center(a) || !center(b)) return false;
  return a == b || (!group_.empty() && group_[std::size_t(block(a))] == group_[std::size_t(block(b))]);
}

template <int Dim>
std::optional<Vec3> ImpactColumns<Dim>::center(int k) const {
  const RigidState* rigid = k < 0 ? nullptr : state_.solids[std::size_t(k)].rigid();
  return rigid ? std::optional(rigid->center) : std::nullopt;
}

template <int Dim>
int ImpactColumns<Dim>::block(int k) const {
  const auto found = std::find(coupling_.bodies.begin(), coupling_.bodies.end(), k);
  return k < 0 || found == coupling_.bodies.end() ? -1 : int(found - coupling_.bodies.begin());
}

template <int Dim>
int ImpactColumns<Dim>::first_unknown(int k) const {
  const int b = block(k);
  return b < 0 ? -1 : coupling_.first[std::size_t(b)];
}

// Two free solids may have slipped since contact acted: at the middle of both places, moments balance.
template <int Dim>
std::array<Vec3, 2> ImpactColumns<Dim>::arms_at_one_place(int first, int second, const Impact::Impulse& i) const {
  const auto one = center(first), two = center(second);
  if (!one || !two) return {i.first_arm, i.second_arm};
  const Vec3 half = 0.5 * (*two + i.second_arm - *one - i.first_arm);
  return {i.first_arm + half, i.second_arm - half};
}

template <int Dim>
Eigen::VectorXd ImpactColumns<Dim>::without_held(int first, Eigen::VectorXd v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.is_held(first + i)) v[i] = 0;
  return v;
}

template <int Dim>
ImpactColumn ImpactColumns<Dim>::column(int first, int second, const std::vector<Impact::Impulse>& impulses) const {
  ImpactColumn c;
  for (const Impact::Impulse& i : impulses) c.size += i.linear.norm();
  const std::array<int, 2> solid{first, second};
  for (std::size_t s : {0, 1}) {
    const auto own = center(solid[s]), other = center(solid[1 - s]);
    const double sign = (s == 0 ? 1 : -1) / c.size;
    BodyImpulse sum;
    const Twist led = own ? Twist{} : prescribed_motion(state_, solid[s], horizon_);
    for (const Impact::Impulse& i : impulses) {
      const std::array<Vec3, 2> arms = arms_at_one_place(first, second, i);
      c.arm[s] += i.linear.norm() / c.size * arms[s];
      sum.linear += sign * i.linear;
      sum.angular += sign * arms[s].cross(i.linear);
      if (!own && other) c.prescribed += sign * i.linear.dot(led.at(*other + arms[1 - s]));
    }
    if (!own) continue;
    c.first_unknown[s] = first_unknown(solid[s]);
    c.part[s] = without_held(c.first_unknown[s], stacked<Dim>(sum.linear, sum.angular));
  }
  return c;
}

// Joints push back: with them M^-1 - M^-1 C'(C M^-1 C')^+ C M^-1 stands for M^-1.
template <int Dim>
Eigen::VectorXd ImpactColumns<Dim>::response(const ImpactColumn& column) const {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(coupling_.size());
  column.add_to(v, 1);
  if (jointed_) return jointed_->solve(v);
  for (std::size_t s : {0, 1}) {
    const int first = column.first_unknown[s], n = twist_size<Dim>;
    if (first < 0) continue;
    v.segment(first, n) = DenseLdlt(Eigen::MatrixXd(coupling_.mass.block(first, first, n, n)))
                              .solve(Eigen::VectorXd(v.segment(first, n)));
  }
  return v;
}

template <int Dim>
Eigen::MatrixXd ImpactColumns<Dim>::products(const std::vector<ImpactColumn>& columns) const {
  const auto n = Eigen::Index(columns.size());
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd v = response(columns[std::size_t(i)]);
    for (Eigen::Index j = 0; j <= i; ++j) A(i, j) = A(j, i) = columns[std::size_t(j)].dot(v);
  }
  return A;
}

template <int Dim>
Vec3 ImpactColumns<Dim>::change_at(const ImpactColumn& column, int side, const Eigen::VectorXd& dv) const {
  const int first = column.first_unknown[std::size_t(side)];
  if (first < 0) return Vec3::Zero();
  const Eigen::VectorXd own = dv.segment(first, twist_size<Dim>);
  return unstacked<Dim>(own, 0, Vec3::Zero()).at(column.arm[std::size_t(side)]);
}

#define SEICHE_INSTANTIATE(D)                                                                                  \
  template std::shared_ptr<const BodyMatrix> jointed_inertia<D>(const SolidCoupling<D>&, const Communicator&); \
  template class ImpactColumns<D>;
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
