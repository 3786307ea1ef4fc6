#pragma once
// Newton's method for the displacements of an elastic body: one time step or static equilibrium.
#include <string>

#include "solid/elastic/body.h"

namespace seiche {

// The incremental potential, J:
//   Phi(u) = 1/2 |v - v*|^2_M + 1/(2 gamma) |u - u0|^2_C + Psi(u) - f.u   with u = u0 + gamma v, M the consistent mass.
// Static equilibrium has gamma = 0, which means no inertia: Psi(u) - f.u.
template <int Dim>
struct IncrementalPotential {
  const ElasticBody<Dim>* body = nullptr;
  double gamma = 0;        // s
  Eigen::VectorXd base;    // u0, m
  Eigen::VectorXd target;  // v*, m/s
  Eigen::VectorXd force;   // f, N
  bool constant = false;   // f is the same at both ends of the step
  SparseMatrix damping;    // C, kg/s; empty: none
};

template <int Dim>
double potential_value(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u);
template <int Dim>
Eigen::VectorXd potential_gradient(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u);
template <int Dim>
SparseMatrix potential_hessian(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u,
                               HessianProjection curvature);

// Degrees of freedom with prescribed displacements (Dirichlet conditions).
struct Pins {
  std::vector<int> dofs;        // Dim node + axis
  std::vector<double> targets;  // m
};

// Fixes all components of these nodes at zero displacement.
template <int Dim>
Pins pin_nodes(const std::vector<int>& nodes);

struct MinimizeOptions {
  double step_tolerance = 1e-9;  // last Newton step relative to the body's size; bounds the error of u
  int max_iterations = 200;
};

struct MinimizeReport {
  bool converged = false;
  std::string failure;            // reason, if not converged
  int iterations = 0;             // Newton steps
  int projected = 0;              // steps with the projected stiffness, where the exact one is indefinite
  double last_step = 0;           // relative to the body's size
  double least_volume_ratio = 0;  // smallest det F at the end, over quadrature points and nodes
};

// Cholesky factors that a body reuses from step to step.
struct ElasticWorkspace {
  SparseCholesky cholesky;
};

// Minimises p from u. u must have det F > 0; so has every iterate. On failure u is the last iterate.
template <int Dim>
[[nodiscard]] MinimizeReport minimize(const IncrementalPotential<Dim>& p, const Pins& pins,
                                      const MinimizeOptions& options, ElasticWorkspace& workspace, Eigen::VectorXd& u);

// Static equilibrium under the force, in equal steps of load and pins. A step at which Newton fails is halved; gives up
// below a thousandth.
template <int Dim>
[[nodiscard]] MinimizeReport solve_static(const ElasticBody<Dim>& body, const Eigen::VectorXd& force, const Pins& pins,
                                          int load_steps, const MinimizeOptions& options, ElasticWorkspace& workspace,
                                          Eigen::VectorXd& u);

}  // namespace seiche
