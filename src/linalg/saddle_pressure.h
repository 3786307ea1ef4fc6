#pragma once
// The pressure block of a saddle-point preconditioner: an approximate inverse of the Schur complement
//   S = D F^-1 D' + Jd N^-1 Jd' (+ J H^-1 J' of bodies that deform),   Jd = J m - D W, N the energies of directions.
#include "linalg/saddle_velocity.h"

namespace seiche {

// Of D F^-1 D' by Cahouet and Chabard 1988: S0^-1 = (AMG of A) / schur_scale + diag(schur_mass); of the rest by
// Woodbury.
class PressurePreconditioner {
 public:
  // Keeps references. `name` as in preconditioner_names(). Collective.
  PressurePreconditioner(const SaddleOperator& K, const VelocityPreconditioner& velocity, const std::string& name,
                         const AmgSettings& settings);

  // For the present H and directions' energies. Why it failed, else empty. Collective.
  [[nodiscard]] std::string refresh();
  void apply(const Vector& r, Vector& z);
  // Takes out what no velocity can reach. Collective.
  void project(Vector& v) const { coupled_.project(v); }
  const std::string& used() const { return used_; }

 private:
  struct Constant {  // of a closed component that bodies feel
    std::vector<int> rows;
    double inverse;  // S0^-1 on it, of sums over rows
  };
  void make_hierarchy();
  bool is_outdated() const;
  void find_constants();
  void find_jd();
  void solve_columns();
  void apply_without_directions(const Vector& r, Vector& z);
  Eigen::VectorXd felt(const std::vector<Vector>& columns, const Vector& r) const;

  const SaddleOperator& K_;
  const VelocityPreconditioner& velocity_;
  CoupledSystem coupled_;
  std::string used_;
  AmgSettings settings_;
  bool deforms_;
  std::unique_ptr<DistributedMatrix> matrix_;  // A + J H^-1 J' / schur_scale where bodies deform
  std::unique_ptr<LinearSystem> filled_;
  Eigen::VectorXd diagonal_;  // of the H it was made for
  PreconditionerOrFailure B_;
  std::vector<Constant> constants_;
  std::vector<Vector> Jd_, Y_;  // Y = S0^-1 Jd
  Eigen::MatrixXd JdY_;
  Eigen::LDLT<Eigen::MatrixXd> small_;  // N + Jd'Y
};

}  // namespace seiche
