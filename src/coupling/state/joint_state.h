#pragma once
// Data of a joint from step to step.
#include <Eigen/Core>

#include "base/vec.h"

namespace seiche {

struct JointState {
  double q = 0;        // coordinate where it was last solved for, whole turns counted: rad or m
  double rate = 0;     // dq/dt of the last solve, rad/s or m/s
  double shown_q = 0;  // coordinate at the state's time
  double gap = 0;      // largest violation where it was last solved for: m, or rad times the body's size
  // Load of the joint on its first body in the last solve: N, and N m about the joint's point, which is `point`.
  Vec3 force{0, 0, 0}, torque{0, 0, 0}, point{0, 0, 0};
  double power = 0;  // that it brings into its bodies: drive, motor, prescribed bodies, W
  bool broken = false;
  Eigen::VectorXd bend = {};  // of each of its constraints: rate of the last solve, a first guess of the next one's
  // Impulses of the last interval's bow at its end (coupling/solids/joint_bow.h): on each body of its constraints, six
  // numbers a body; along each of them; on its first body about its point. Empty: none.
  Eigen::VectorXd bow = {}, bow_rows = {}, bow_load = {};
  double interval = 0;  // of the last solve, s
};

}  // namespace seiche
