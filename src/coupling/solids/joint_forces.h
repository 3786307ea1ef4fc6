#pragma once
// Springs, dampers, motors, limits and friction of joints in one solve.
#include "coupling/state/joint_rows.h"
#include "solid/energy/velocity_potential.h"
#include "solid/joint/force.h"

namespace seiche {

// A force along a joint's coordinate.
struct JointForce {
  enum class Kind { spring, motor, friction } kind = Kind::spring;
  int joint = 0;
  PlacedRow::Rate on_first;                 // of the coordinate's rate
  Vec3 point{0, 0, 0};                      // the reference point of the first body
  std::vector<std::pair<int, double>> row;  // of the rate by the unknowns
  double known = 0;                         // part of the rate by prescribed bodies
  double before = 0;                        // rate before the solve
  CappedForce force;

  double rate(const Eigen::VectorXd& v) const;
};

// A limit of a coordinate: gap = gap_now - H scale rate > 0, m.
struct JointLimit {
  std::vector<std::pair<int, double>> row;
  double known = 0, gap_now = 0, scale = 1;
  int joint = 0;
  double side = 1;  // 1: upper, -1: lower
};

struct LimitBarrier {
  double reach = 0, stiffness = 0;  // m, N/m
  double dt = 0, horizon = 0;       // s
};

// Energy of capped forces and limits: dt/H b(gap) of each limit, with the barrier b of contact.
class JointPotential : public VelocityPotential {
 public:
  JointPotential(std::vector<JointForce> forces, std::vector<JointLimit> limits, LimitBarrier barrier)
      : forces_(std::move(forces)), limits_(std::move(limits)), barrier_(barrier) {}
  double energy(const Eigen::VectorXd& v) const override;
  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override;
  Eigen::SparseMatrix<double> hessian(const Eigen::VectorXd& v, HessianProjection curvature,
                                      IndexRange columns) const override;
  double step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const override;
  const std::vector<JointLimit>& limits() const { return limits_; }
  // Impulse of a limit on the coordinate.
  double impulse(const JointLimit& limit, const Eigen::VectorXd& v) const;

 private:
  double gap(const JointLimit& limit, const Eigen::VectorXd& v) const;

  std::vector<JointForce> forces_;
  std::vector<JointLimit> limits_;
  LimitBarrier barrier_;
};

}  // namespace seiche
