#pragma once
// Monolithic solve for velocities and pressures, for flows in which viscosity couples the faces.
#include <memory>
#include <string>
#include <vector>

#include "linalg/saddle/system.h"

namespace seiche {

struct SaddleOptions {
  // Bound on |b - K x| / scale, recomputed, for momentum and for continuity separately. Momentum: norm of diag(F,
  // H)^-1, relative to f, g and the pressure gradient that q requires. Continuity: 2-norm, relative to `flux_scale` of
  // solve(). Bounds the error of the velocity and the loss of volume.
  double tolerance = 1e-8;
  int max_iterations = 400;             // of each attempt
  std::string preconditioner = "auto";  // for the pressure
  int fail_first = 0;                   // for tests: the first attempts return a wrong x and claim success
};

struct SaddleReport {
  bool converged = false;
  int iterations = 0;                        // over all attempts
  double momentum = 0, continuity = 0;       // recomputed, relative
  double residual = 0;                       // the larger of the two
  double mismatch = 0;                       // |part of q that no velocity can match| / |q|
  std::string used;                          // the last attempt
  std::vector<std::string> failed_attempts;  // one line for each failed attempt

  void set(double of_momentum, double of_continuity);
};

class SaddlePreconditioner;

// Solves several systems with the same F, G, D, J and different H. Preconditioner parts without H are kept.
class SaddleSolver {
 public:
  // Keeps references to the members of `system`. Throws Error(machine) for more rows than hypre can index. Collective.
  SaddleSolver(const SaddleSystem& system, const SaddleOptions& options, const Communicator& ranks);
  ~SaddleSolver();

  // Solves from the initial u, v, p. q is made compatible first; p has no part in the null space. `flux_scale` = 0
  // means the fluxes of the flow without the constraint. Tries GMRES, then the other attempts of the fallback chain;
  // the residual of every result is recomputed and checked. Collective.
  [[nodiscard]] SaddleReport solve(const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g, const Vector& q,
                                   Vector& u, Eigen::VectorXd& v, Vector& p, double flux_scale = 0);
  // Solves [F G; G' H] (u, v) = (f, g), without the constraint, by preconditioned conjugate gradients. Collective.
  [[nodiscard]] SaddleReport solve_viscous(const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g, Vector& u,
                                           Eigen::VectorXd& v);

  // Closed components of A that bodies feel: H and J determine their mean pressure.
  const std::vector<int>& sensed_components() const { return coupled_.sensed_components(); }

 private:
  struct Problem;
  struct Fallback;
  struct Residual;
  struct Outcome {
    int iterations = 0;
    std::string failure;
  };
  SaddlePreconditioner& build(const std::string& pressure, const std::string& strength);
  void set_bodies(const BodyMatrix& H);
  std::string find_bad(const Vector& f, const Eigen::VectorXd& g, const Vector& q) const;
  double make_compatible(Vector& q) const;
  void project_pressure(Vector& x) const;
  Vector momentum_weight() const;
  double rounding_of_divergence(const Vector& u) const;
  Problem pose(const Vector& f, const Eigen::VectorXd& g, const Vector& q, double flux_scale);
  Residual measure(const Problem& problem, const Vector& x) const;
  std::vector<Fallback> make_fallback_chain() const;
  Outcome attempt(const Fallback& fallback, const Problem& problem, Vector& x);
  Outcome minimise(SaddlePreconditioner& B, const Problem& problem, Vector& x);
  Outcome reduce_residual(SaddlePreconditioner& B, const Problem& problem, Vector& x);
  Outcome iterate_viscous(SaddlePreconditioner& B, const Vector& w, const Vector& b, Vector& x, SaddleReport& report);
  void try_fallback_chain(const Problem& problem, Vector& x, SaddleReport& report);

  SaddleSystem system_;
  SaddleOptions options_;
  SaddleOperator K_;
  CoupledSystem coupled_;  // for the null space of p
  std::vector<std::pair<std::string, std::unique_ptr<SaddlePreconditioner>>> built_;
};

}  // namespace seiche
