#pragma once
// Bodies in viscous liquid: their velocities, the liquid's velocity and its pressure in one saddle-point problem.
#include <functional>

#include "coupling/solve/coupled_problem.h"
#include "coupling/solve/viscous_coupling.h"
#include "linalg/saddle/solver.h"

namespace seiche {

// Solvers for liquid and bodies together (coupled), and for the liquid with given motion of the bodies (alone). alone()
// builds its solver on the first call. Collective.
struct ViscousSolvers {
  SaddleSolver& coupled;
  std::function<SaddleSolver&()> alone;
};

// e(v) = 1/2 (v - v*)'M(v - v*) + the minimum, given v, of the liquid's kinetic energy and dissipation:
//   F u + G v + D'p^ = f,   G'u + (M + H_vv + K) v + J^'p^ = M v* + r + g,   D u + J^ v = q,
// with p^ = -dt p and J^ = A_f J = ViscousStep::J(). K and r: Hessian and linear term of contact and elastic forces.
// Fixed unknowns have their prescribed velocities, which the right-hand sides include.
template <int Dim>
class ViscousProblem : public CoupledProblem<Dim> {
 public:
  // Keeps references. `area`: of a face. `u` and `p` (rows of the system) are the first guess and hold the last
  // solution. Pressures of closed liquid that bodies feel are told as the constraint's part of the gradient.
  ViscousProblem(const SolidCoupling<Dim>& coupling, const ViscousStep<Dim>& viscous, const ViscousSolvers& solvers,
                 double area, const NullSpace& closed, Vector& u, Vector& p, const Communicator& ranks);
  InertiaResponse minimise(const SparseMatrix& K, const Eigen::VectorXd& r) override;
  InertiaResponse respond(const Eigen::VectorXd& v) override;

 private:
  using CoupledProblem<Dim>::coupling_;
  using CoupledProblem<Dim>::report_;
  std::string solve(SaddleSolver& solver, const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g,
                    const Vector& q, Eigen::VectorXd& v);
  SaddleReport solve_with_joints(SaddleSolver& solver, const BodyMatrix& H, Vector f, Eigen::VectorXd g, Vector q,
                                 Eigen::VectorXd& v);
  InertiaResponse response_at(const Eigen::VectorXd& v) const;
  Eigen::VectorXd reaction_of_means() const;

  const ViscousStep<Dim>& viscous_;
  ViscousSolvers solvers_;
  double area_;
  const NullSpace& closed_;
  Vector &u_, &p_;
  Communicator ranks_;
  BodyMatrix H_, none_;
  Eigen::VectorXd last_;  // velocities of the last minimum
};

}  // namespace seiche
