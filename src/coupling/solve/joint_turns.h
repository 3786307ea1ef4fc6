#pragma once
// Turns in which the rates of joints are found: each corrects them by the gaps that the last solve leaves at the end of
// its interval.
#include <functional>

#include "coupling/solids/joint_motion.h"
#include "linalg/core/body_matrix.h"

namespace seiche {

// Between two solves the gaps are closed by the bodies' masses alone. What is left is the difference between these and
// the masses with liquid, times the bend of the paths over the interval.
template <int Dim>
class JointTurns {
 public:
  // Sets the first rates, from velocities near the solution. Keeps a reference. Collective.
  JointTurns(const SolidCoupling<Dim>& coupling, const Communicator& ranks, const Eigen::VectorXd& near);
  // Adds the stiffness of contact, friction and elastic solids where v was found to the masses that close the gaps.
  void stiffen(const SparseMatrix& K);
  // Corrects the rates for velocities v that fulfil the present ones. If the change that v needs is small, v is
  // corrected, too, and no further solve is due. Returns what fails, or "".
  std::string correct(Eigen::VectorXd& v, const std::function<bool(const Eigen::VectorXd&)>& is_small);
  bool done() const { return done_; }
  // Sets the joints' impulses where all other energies have the gradient `residual`: C'mu = -residual.
  void finish(Eigen::VectorXd residual) const;

 private:
  void close(Eigen::VectorXd& v) const;
  void close_gaps(Eigen::VectorXd& v) const;
  Eigen::VectorXd follow_bow(const Eigen::VectorXd& v) const;

  const SolidCoupling<Dim>& coupling_;
  JointMotion<Dim>& motion_;
  std::shared_ptr<BodyMatrix> mass_;
  Communicator ranks_;
  SparseMatrix stiffness_;       // of stiffen(); empty: none
  Eigen::VectorXd shift_;        // of v by the last correction that no solve followed
  Eigen::VectorXd solved_with_;  // impulse of the bow in the last solve
  int turns_ = 0;
  double last_excess_ = 0;
  bool done_ = false;
};

}  // namespace seiche
