#pragma once
// The bow of jointed bodies' paths, whose energy straight ways between two solves leave out.
#include "coupling/solids/coupled_step.h"
#include "coupling/solids/joint_motion.h"

namespace seiche {

// Over the interval H bodies go straight from closed joints to closed joints; their true paths bow by
//   delta = least displacement, weighted by mass, that closes the joints at H/2.
// The leapfrog's action over H lacks the bow's kinetic energy 8/(3 H) delta'M delta. Its derivatives by both ends of
// the interval are impulses -8/(3 H) M delta, at this solve and the next. They act along the joints' rows, so they are
// part of the joints' loads. The bow by gravity, fields and loads has the action H^3/24 |a|^2, a the acceleration that
// the joints leave; half of it counts at either end.
//
// For rigid bodies that joints hold to the world or to prescribed solids. Others keep their momenta to rounding, which
// are those of straight ways. Forces' part only where no liquid touches them: its forces are known after the solve.
template <int Dim>
class JointBow {
 public:
  // Keeps references to what `step` refers to.
  JointBow(const JointSet<Dim>& joints, const CoupledStep<Dim>& step, const SolidCoupling<Dim>& coupling,
           const JointMotion<Dim>& motion);

  bool empty() const { return !any_; }
  // Impulses of the last interval's bow and of the forces', which the solve does not change.
  Eigen::VectorXd given() const;
  // Impulses of the coming interval by the velocities last followed.
  const Eigen::VectorXd& impulse() const { return impulse_; }
  // Sets the bow of the coming interval from velocities v. Returns the change of impulse().
  Eigen::VectorXd follow(const Eigen::VectorXd& v);
  // Adds load and power of the bows on a joint to its state, then keeps there what acts at the next solve.
  void take(int joint, JointState& state) const;

 private:
  using Rate = PlacedRow::Rate;
  using Inverse = Eigen::Matrix<double, 6, 6>;

  void find_anchored();
  void set_displacements(const std::vector<PlacedRow>& rows);
  std::vector<Inverse> inverse_masses(const JointedBodies& bodies) const;
  void factor(const std::vector<PlacedRow>& placed, const std::vector<Inverse>& inverse);
  Eigen::VectorXd values(const std::vector<PlacedRow>& rows) const;
  std::vector<Rate> loads(const std::vector<PlacedRow>& rows, const Eigen::VectorXd& y) const;
  bool close(const JointedBodies& middle, const Eigen::VectorXd& v, std::vector<PlacedRow>& rows);
  void set_impulses(const JointedBodies& middle, const Eigen::VectorXd& v, const std::vector<PlacedRow>& rows);
  void add_to_unknowns(std::size_t place, const Rate& load, Eigen::VectorXd& impulse) const;
  std::vector<Rate> forces_on(const JointedBodies& bodies) const;
  Eigen::VectorXd impulse_by_forces() const;
  std::vector<Rate> free_accelerations(const std::vector<Inverse>& inverse) const;
  void add_changes(const std::vector<Rate>& a, double way, const Eigen::VectorXd& y, Eigen::VectorXd& sum) const;
  void take_rows(std::size_t begin, JointState& state) const;

  const JointSet<Dim>& joints_;
  const CoupledStep<Dim> step_;
  const SolidCoupling<Dim>& coupling_;
  const JointMotion<Dim>& motion_;
  std::vector<char> anchored_, dry_;        // of each row of the motion: it takes part; no liquid touches its bodies
  bool any_ = false, fails_ = false;        // fails_: the bow of this solve does not close
  ConstraintRows constraints_;              // of these rows, by the six motions of each place
  std::vector<Inverse> inverse_;            // of the places in the middle that close() was given
  Eigen::VectorXd y_;                       // multipliers of delta: M delta = C'y
  std::vector<Rate> delta_;                 // of each place
  Eigen::VectorXd impulse_;                 // on the unknowns, at this solve
  std::vector<Rate> load_;                  // of each joint: on the first body, about the joint's point
  std::vector<Eigen::VectorXd> now_, end_;  // of each joint: on each body of its rows, at this solve and the next
};

// coupling.push with the impulse of the coming interval's bow.
template <int Dim>
Eigen::VectorXd push_with_bow(const SolidCoupling<Dim>& coupling);

}  // namespace seiche
