#pragma once
// Preconditioner of the Schur complement for pressure: velocities of liquid and bodies are eliminated.
#include "linalg/core/dense_factors.h"
#include "linalg/precond/hypre_adapter.h"
#include "linalg/spd/coupled_system.h"

namespace seiche {

// Symmetric positive approximate inverse of
//   S0 + c Jd N^-1 Jd' (+ c J H^-1 J' of deformable bodies),   S0^-1 ~ A^-1 + diag(mass)   (Cahouet, Chabard 1988).
// A^-1 is applied by multigrid and the dense columns Jd by the Woodbury formula. Deformable bodies enter the matrix
// from which the multigrid is made.
class SchurPreconditioner {
 public:
  // Keeps references to A and J. `mass` may be empty; `name` is one of preconditioner_names(). Collective.
  SchurPreconditioner(const LinearSystem& A, const BlockColumns& J, double c, Vector mass, const std::string& name,
                      const AmgSettings& settings);

  // Replaces A^-1 and `mass`. Not for systems with deformable bodies.
  void set_liquid(std::unique_ptr<Preconditioner> inverse);
  void set_directions(std::vector<Vector> Jd);
  // Updates for the current H and N. Returns the reason of a failure, else an empty string. Collective.
  [[nodiscard]] std::string refresh(const BodyMatrix& H, const Eigen::MatrixXd& N);
  void apply(const Vector& r, Vector& z);
  // Removes the null space. Collective.
  void project(Vector& v) const { coupled_.project(v); }

 private:
  struct Constant {  // mode of a closed component that bodies feel
    std::vector<int> rows;
    double inverse;  // factor of S0^-1 for the sum over the rows
  };
  void make_hierarchy(const BodyMatrix& H);
  bool is_outdated(const BodyMatrix& H) const;
  void find_constants(const BodyMatrix& H);
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
  std::unique_ptr<DistributedMatrix> matrix_;  // A + c J H^-1 J' with deformable bodies
  std::unique_ptr<LinearSystem> filled_;
  Eigen::VectorXd diagonal_;  // of the H that matrix_ was made for
  PreconditionerOrFailure B_;
  std::vector<Constant> constants_;
  std::vector<Vector> Jd_, Y_;  // Y = S0^-1 Jd
  Eigen::MatrixXd JdY_;
  DenseLdlt small_;  // N / c + Jd'Y
};

}  // namespace seiche
