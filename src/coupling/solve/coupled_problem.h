#pragma once
// Inertia of bodies and liquid as one quadratic energy of the bodies' velocities, for the contact solve.
#include "coupling/solids/joint_motion.h"
#include "coupling/solids/solid_coupling.h"
#include "linalg/core/body_matrix.h"

namespace seiche {

// Reduces H v = r to the free unknowns f, with prescribed v_h: H_ff v_f = r_f - H_fh v_h. Rows of fixed unknowns keep
// their diagonal entry.
template <int Dim>
SparseMatrix uncouple_held(const SolidCoupling<Dim>& coupling, const SparseMatrix& H, Eigen::VectorXd& r);

// The same in place, with the columns of H shared out over the ranks. Collective.
template <int Dim>
void uncouple_held_shared(const SolidCoupling<Dim>& coupling, const Communicator& ranks, SparseMatrix& H,
                          Eigen::VectorXd& r);

// True if C v is the rate that the joints prescribe.
template <int Dim>
bool holds_joints(const SolidCoupling<Dim>& coupling, const Eigen::VectorXd& v);

template <int Dim>
class CoupledProblem : public InertiaProblem {
 public:
  explicit CoupledProblem(const SolidCoupling<Dim>& coupling)
      : coupling_(coupling), missing_(coupling.cavities.size()) {}
  int size() const override { return coupling_.size(); }
  bool holds(const Eigen::VectorXd& v) const override;
  void linearise_at(const Eigen::VectorXd& v) override;
  // Missing flux out of all rows of each of coupling.cavities in the last solve, per face area, m/s.
  const std::vector<double>& missing_fluxes() const { return missing_; }
  const SolveReport& report() const { return report_; }  // of all solves so far

 protected:
  // v with fixed unknowns set to zero.
  Eigen::VectorXd free_part(Eigen::VectorXd v) const;
  // Sets fixed unknowns to their prescribed velocities.
  void hold(Eigen::VectorXd& v) const;
  // Velocities that the joints prescribe; 0 without joints. H: with its constraints.
  Eigen::VectorXd prescribed_by_joints(const BodyMatrix& H) const;
  // b + by * (missing fluxes), in the rows of the cavities.
  Vector with_missing_fluxes(Vector b, double by) const;

  const SolidCoupling<Dim>& coupling_;
  SolveReport report_;
  std::vector<double> missing_;
};

// Mean of p over the rows of each of the closed components `sensed`, in these rows; 0 in others. Collective.
Vector component_means(const NullSpace& closed, const std::vector<int>& sensed, const Vector& p,
                       const Communicator& ranks);

InertiaResponse failed_response(const std::string& why);
InertiaResponse indefinite_response();

}  // namespace seiche
