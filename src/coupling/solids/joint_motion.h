#pragma once
// Joints in one solve: constraints C v = rate on the velocities, made where the solids are, that close all joints where
// the next solve stands.
#include "coupling/solids/joint_forces.h"
#include "coupling/solids/solid_coupling.h"

namespace seiche {

class BodyMatrix;
template <int Dim>
class JointBow;

// C stays during a solve (SolidCoupling::J.constraints); `rate` does not: c(x + H v) = 0 is found in turns, by
//   rate <- rate - c(x + H v)/H.
// Impulses act along C of the start of the interval, where both sides of a joint are one point. So momenta are kept,
// and energy as by the leapfrog (SHAKE: Ryckaert, Ciccotti, Berendsen 1977). Elastic solids feel all forces at the end
// of the interval, so impulses on their patches act along C where these will be by the velocities of the last solve.
template <int Dim>
class JointMotion {
 public:
  // Keeps references to the state of `step` and to `coupling`.
  JointMotion(const JointSet<Dim>& joints, const CoupledStep<Dim>& step, const SolidCoupling<Dim>& coupling);

  Eigen::VectorXd rate;            // b: m/s, rad/s
  Eigen::VectorXd impulse;         // multipliers of the last solve, N s and N m s
  Eigen::VectorXd left;            // gaps that the solve left, m and rad
  Eigen::VectorXd given;           // rates of C v that drives and prescribed solids give, m/s and rad/s
  std::vector<JointForce> forces;  // all along coordinates
  std::shared_ptr<const JointPotential> potential;  // of capped forces and limits; null: none
  Eigen::VectorXd slack;                            // of C v = rate, below what closes joints: m/s, rad/s
  std::vector<char> wet;                            // of each solid: liquid or gas touches it
  std::shared_ptr<JointBow<Dim>> bow;               // null: none
  std::shared_ptr<const BodyMatrix> inertia;        // M with C, factored, of rigid solids that are all free; else null
  int turns = 0;  // corrections of `rate` in this solve, after which the solids were solved for again

  // Velocities of the unknowns as the state has them: before the solve, then those found.
  Eigen::VectorXd velocity_in_state() const;
  const JointedBodies& bodies() const { return bodies_; }
  const std::vector<PlacedRow>& rows() const { return rows_; }
  bool any_wet() const { return std::find(wet.begin(), wet.end(), 1) != wet.end(); }
  double horizon() const { return horizon_; }
  double dt() const { return dt_; }
  // Places of the bodies after `span` with velocities v, and the constraints in places `bodies` near these.
  JointedBodies bodies_after(const Eigen::VectorXd& v, double span) const;
  std::vector<PlacedRow> rows_after(const JointedBodies& bodies, const Eigen::VectorXd& v, double span) const;
  // c(x + H v): m, rad.
  Eigen::VectorXd gaps(const Eigen::VectorXd& v) const;
  // The largest gap over its tolerance, and the joints that exceed theirs.
  double excess(const Eigen::VectorXd& gaps) const;
  std::string names_of_open(const Eigen::VectorXd& gaps) const;
  std::string names_of_driven(const Eigen::VectorXd& parts) const;  // of rows whose part is not 0
  double largest_gap(const Eigen::VectorXd& gaps) const;            // m

 private:
  void lead_patches(const std::vector<double>& near);

  const JointSet<Dim>& joints_;
  JointedBodies bodies_;
  std::vector<PlacedRow> rows_;
  const State<Dim>& state_;
  const SolidCoupling<Dim>& coupling_;
  double dt_, horizon_;
};

// Rates (v, w) of the bodies by the stacked unknowns; zero for prescribed ones.
template <int Dim>
std::vector<PlacedRow::Rate> rates_of(const SolidCoupling<Dim>& coupling, const JointedBodies& bodies,
                                      const Eigen::VectorXd& v);

// Mean rates of the bodies that are prescribed solids from `time` over `span` (s), zero for others.
template <int Dim>
std::vector<PlacedRow::Rate> prescribed_rates(const JointSet<Dim>& joints, const Participants<Dim>& solids, double time,
                                              double span);

// The row as a vector over the unknowns; fixed ones left out. Appends its entries.
template <int Dim>
void append_row(const PlacedRow& row, int number, const JointedBodies& bodies, const SolidCoupling<Dim>& coupling,
                std::vector<Eigen::Triplet<double>>& entries);

}  // namespace seiche
