#pragma once
// What contacts push against: the bodies' inertia and the liquid, as one quadratic energy of the bodies' velocities.
#include "coupling/solids/solid_coupling.h"

namespace seiche {

// H v = r with v known where it is held: H_ff v_f = r_f - H_fh v_h. Rows of what is held keep their diagonal.
template <int Dim>
SparseMatrix uncouple_held(const SolidCoupling<Dim>& coupling, const SparseMatrix& H, Eigen::VectorXd& r);

template <int Dim>
class CoupledProblem : public InertiaProblem {
 public:
  explicit CoupledProblem(const SolidCoupling<Dim>& coupling)
      : coupling_(coupling), missing_(coupling.cavities.size()) {}
  int size() const override { return coupling_.size(); }
  bool holds(const Eigen::VectorXd& v) const override;
  void linearise_at(const Eigen::VectorXd& v) override;
  // Flux out of the rows of each of coupling.swept that the last solve was told of, per face area, m/s.
  const std::vector<double>& missing_fluxes() const { return missing_; }
  const SolveReport& report() const { return report_; }  // of all solves so far

 protected:
  // v where it is free, zero where it is held.
  Eigen::VectorXd free_part(Eigen::VectorXd v) const;
  // Sets what is held.
  void hold(Eigen::VectorXd& v) const;
  // b + by (flux that surfaces sweep beyond J v).
  Vector with_missing_fluxes(Vector b, double by) const;

  const SolidCoupling<Dim>& coupling_;
  SolveReport report_;
  std::vector<double> missing_;
};

InertiaResponse failed_response(const std::string& why);
InertiaResponse indefinite_response();

}  // namespace seiche
