#include <algorithm>

#include "coupling/solids/joint_forces.h"
#include "solid/contact/barrier.h"

namespace seiche {
namespace {

using JointColumns = std::vector<std::pair<int, double>>;

double dot(const JointColumns& row, const Eigen::VectorXd& v) {
  double sum = 0;
  for (const auto& [i, part] : row) sum += part * v[i];
  return sum;
}

void add(const JointColumns& row, double by, Eigen::VectorXd& gradient) {
  for (const auto& [i, part] : row) gradient[i] += by * part;
}

void add_product(const JointColumns& row, double by, IndexRange columns, std::vector<Eigen::Triplet<double>>& entries) {
  for (const auto& [j, other] : row)
    if (j >= columns.begin && j < columns.end)
      for (const auto& [i, part] : row) entries.emplace_back(i, j, by * part * other);
}

}  // namespace

double JointForce::rate(const Eigen::VectorXd& v) const {
  return known + dot(row, v);
}

double JointPotential::gap(const JointLimit& limit, const Eigen::VectorXd& v) const {
  return limit.gap_now - barrier_.horizon * limit.scale * limit.side * (limit.known + dot(limit.row, v));
}

double JointPotential::energy(const Eigen::VectorXd& v) const {
  double sum = 0;
  for (const JointForce& f : forces_) sum += f.force.energy(f.rate(v));
  for (const JointLimit& limit : limits_) {
    const double open = gap(limit, v);
    if (open <= 0) return std::numeric_limits<double>::infinity();
    sum += barrier_.dt / barrier_.horizon * contact::barrier(open, barrier_.reach, barrier_.stiffness).value;
  }
  return sum;
}

double JointPotential::impulse(const JointLimit& limit, const Eigen::VectorXd& v) const {
  const contact::Barrier b = contact::barrier(gap(limit, v), barrier_.reach, barrier_.stiffness);
  return barrier_.dt * limit.scale * limit.side * b.slope;
}

void JointPotential::add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const {
  for (const JointForce& f : forces_) add(f.row, -f.force.impulse(f.rate(v)), gradient);
  for (const JointLimit& limit : limits_) add(limit.row, -impulse(limit, v), gradient);
}

Eigen::SparseMatrix<double> JointPotential::hessian(const Eigen::VectorXd& v, HessianProjection /*curvature*/,
                                                    IndexRange columns) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const JointForce& f : forces_) add_product(f.row, f.force.curvature(f.rate(v)), columns, entries);
  for (const JointLimit& limit : limits_) {
    const contact::Barrier b = contact::barrier(gap(limit, v), barrier_.reach, barrier_.stiffness);
    add_product(limit.row, barrier_.dt * barrier_.horizon * limit.scale * limit.scale * b.curvature, columns, entries);
  }
  Eigen::SparseMatrix<double> K(v.size(), v.size());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

// Keeps a tenth of each gap.
double JointPotential::step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const {
  constexpr double kept = 0.1;
  double share = 1;
  for (const JointLimit& limit : limits_) {
    const double open = gap(limit, v), way = gap(limit, v + dv) - open;
    if (open + way < kept * open) share = std::min(share, (1 - kept) * open / -way);
  }
  return share;
}

}  // namespace seiche
