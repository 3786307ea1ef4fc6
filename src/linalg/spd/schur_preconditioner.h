#pragma once
// Preconditioners of Schur complements on pressures: what liquid and bodies, eliminated, leave.
#include <Eigen/Cholesky>

#include "linalg/precond/hypre_adapter.h"
#include "linalg/spd/coupled_system.h"

namespace seiche {

// An approximate inverse, symmetric and positive, of
//   S0 + c Jd N^-1 Jd' (+ c J H^-1 J' of bodies that deform),   S0^-1 ~ A^-1 + diag(mass)   (Cahouet, Chabard 1988),
// A^-1 by multigrid, the dense columns Jd by Woodbury, bodies that deform in the matrix that multigrid is made from.
class SchurPreconditioner {
 public:
  // Keeps references to A and J. `mass` may be empty; `name` as in preconditioner_names(). Collective.
  SchurPreconditioner(const LinearSystem& A, const BlockColumns& J, double c, Vector mass, const std::string& name,
                      const AmgSettings& settings);

  // In place of A^-1 and mass, where no body deforms.
  void set_liquid(std::unique_ptr<Preconditioner> inverse);
  void set_directions(std::vector<Vector> Jd);
  // For the present H and N. Why it failed, else empty. Collective.
  [[nodiscard]] std::string refresh(const BodyMatrix& H, const Eigen::MatrixXd& N);
  void apply(const Vector& r, Vector& z);
  // Takes out the null space. Collective.
  void project(Vector& v) const { coupled_.project(v); }

 private:
  struct Constant {  // of a closed component that bodies feel
    std::vector<int> rows;
    double inverse;  // S0^-1 on it, of sums over rows
  };
  void make_hierarchy(const SparseMatrix& H);
  bool is_outdated(const SparseMatrix& H) const;
  void find_constants(const SparseMatrix& H);
  void solve_columns();
  void apply_without_directions(const Vector& r, Vector& z);
  Eigen::VectorXd felt(const std::vector<Vector>& columns, const Vector& r) const;

  const LinearSystem& A_;
  const BlockColumns& J_;
  CoupledSystem coupled_;
  Vector mass_;
  std::string used_;
  AmgSettings settings_;
  bool deforms_;
  std::unique_ptr<DistributedMatrix> matrix_;  // A + c J H^-1 J' where bodies deform
  std::unique_ptr<LinearSystem> filled_;
  Eigen::VectorXd diagonal_;  // of the H it was made for
  PreconditionerOrFailure B_;
  std::vector<Constant> constants_;
  std::vector<Vector> Jd_, Y_;  // Y = S0^-1 Jd
  Eigen::MatrixXd JdY_;
  Eigen::LDLT<Eigen::MatrixXd> small_;  // N / c + Jd'Y
};

}  // namespace seiche
