#pragma once
// Bodies in inviscid liquid: their velocities and the liquid's pressure.
#include "coupling/solve/coupled_problem.h"
#include "linalg/kkt/solver.h"

namespace seiche {

// e(v) = 1/2 (v - v*)'M(v - v*) + the kinetic energy that the liquid must gain to make room, A p + c1 J v = b:
//   grad e = M (v - v*) - c2 J'p,  c1 = rho h/dt, c2 = dt A_f.
// With a Hessian K of contact and elastic forces, H = M + K:
//   (A + c1 c2 J H^-1 J') p = b - c1 J H^-1 (M v* + r),  H v = M v* + r + c2 J'p.
// Fixed unknowns have their prescribed velocities, which b includes. With joints, C v = rate, H^-1 stands for its part
// on C v = 0 (BodyMatrix), and the second equation lacks the joints' impulses.
template <int Dim>
class LiquidProblem : public CoupledProblem<Dim> {
 public:
  // Keeps references; `pressure` is the first guess and holds the last solution.
  LiquidProblem(const SolidCoupling<Dim>& coupling, SpdSolver& solver, const NullSpace& closed, const Vector& b,
                Vector& pressure, double c1, double c2, const Communicator& ranks);
  // From now on minimise() solves for velocities and pressures together, without factors of H: for bodies too large to
  // factor. An indefinite H is then noticed only if the iteration meets v'H v < 0. The ranks then share the columns of
  // K and H. Keeps a reference.
  void solve_together(KktSolver& kkt) { kkt_ = &kkt; }
  IndexRange columns() const override;
  Eigen::VectorXd multiply(const SparseMatrix& K, const Eigen::VectorXd& v) const override;
  InertiaResponse minimise(const SparseMatrix& K, const Eigen::VectorXd& r) override;
  InertiaResponse respond(const Eigen::VectorXd& v) override;
  bool notices_indefinite() const override { return !kkt_; }

 private:
  using CoupledProblem<Dim>::coupling_;
  using CoupledProblem<Dim>::report_;
  using CoupledProblem<Dim>::free_part;
  using CoupledProblem<Dim>::hold;
  std::string solve(const BodyMatrix& H, const Vector& b);
  InertiaResponse minimise_together(const SparseMatrix& K, Eigen::VectorXd push);
  void add_up(const SolveReport& one);
  Eigen::VectorXd impulse_of(const Vector& pressure) const;
  Eigen::VectorXd impulse_on_held() const;
  Eigen::VectorXd impulse_of_means() const;
  InertiaResponse respond_with_pressure(const Eigen::VectorXd& v, const Eigen::VectorXd& force) const;

  SpdSolver& solver_;
  const NullSpace& closed_;
  const Vector& b_;
  Vector& pressure_;
  double c1_, c2_;
  Communicator ranks_;
  BodyMatrix H_, none_;
  // Scale of the solver's tolerance: the flows that liquid and bodies would have alone. The right-hand side is none,
  // since it grows without bound for ever lighter bodies.
  double scale_ = 0;
  KktSolver* kkt_ = nullptr;
  Eigen::VectorXd last_;  // of the last minimise_together()
};

}  // namespace seiche
