#include "coupling/solids/impact_columns.h"

#include <algorithm>

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

}  // namespace

double ImpactColumn::parting(const Eigen::VectorXd& v) const {
  double speed = prescribed;
  for (std::size_t s : {0, 1})
    if (first_unknown[s] >= 0) speed += part[s].dot(v.segment(first_unknown[s], part[s].size()));
  return speed;
}

void ImpactColumn::add_to(Eigen::VectorXd& push, double impulse) const {
  for (std::size_t s : {0, 1})
    if (first_unknown[s] >= 0) push.segment(first_unknown[s], part[s].size()) += impulse * part[s];
}

template <int Dim>
std::optional<Vec3> ImpactColumns<Dim>::center(int k) const {
  const RigidState* rigid = k < 0 ? nullptr : state_.solids[std::size_t(k)].rigid();
  return rigid ? std::optional(rigid->center) : std::nullopt;
}

template <int Dim>
int ImpactColumns<Dim>::first_unknown(int k) const {
  const auto block = std::find(coupling_.bodies.begin(), coupling_.bodies.end(), k);
  return k < 0 || block == coupling_.bodies.end() ? -1 : coupling_.first[std::size_t(block - coupling_.bodies.begin())];
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

template <int Dim>
double ImpactColumns<Dim>::dot(const ImpactColumn& a, const ImpactColumn& b) {
  double sum = 0;
  for (std::size_t s : {0, 1})
    for (std::size_t r : {0, 1})
      if (a.first_unknown[s] >= 0 && a.first_unknown[s] == b.first_unknown[r]) sum += a.part[s].dot(b.part[r]);
  return sum;
}

template <int Dim>
ImpactColumn ImpactColumns<Dim>::over_mass(ImpactColumn column) const {
  for (std::size_t s : {0, 1}) {
    const int first = column.first_unknown[s], n = twist_size<Dim>;
    if (first < 0) continue;
    column.part[s] = DenseLdlt(Eigen::MatrixXd(coupling_.mass.block(first, first, n, n))).solve(column.part[s]);
  }
  return column;
}

template <int Dim>
Eigen::MatrixXd ImpactColumns<Dim>::products(const std::vector<ImpactColumn>& columns) const {
  const auto n = Eigen::Index(columns.size());
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ImpactColumn over = over_mass(columns[std::size_t(i)]);
    for (Eigen::Index j = 0; j <= i; ++j) A(i, j) = A(j, i) = dot(columns[std::size_t(j)], over);
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

template class ImpactColumns<2>;
template class ImpactColumns<3>;

}  // namespace seiche
