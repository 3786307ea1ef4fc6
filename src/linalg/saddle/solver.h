#pragma once
// Velocities and pressures at once, where viscosity lets no velocity be eliminated.
#include <memory>
#include <string>
#include <vector>

#include "linalg/saddle/system.h"

namespace seiche {

struct SaddleOptions {
  // Of |b - K x| / scale, recomputed, of momentum and of continuity each. Momentum in the norm of diag(F, H)^-1,
  // relative to f and g and to what q drives; continuity in the 2-norm, relative to `flux_scale` of solve(). Bounds the
  // error in the velocity, and the volume lost.
  double tolerance = 1e-8;
  int max_iterations = 400;             // of a rung of the ladder
  std::string preconditioner = "auto";  // of the pressure
  int fail_first = 0;                   // for tests: the first rungs return a wrong x and claim success
};

struct SaddleReport {
  bool converged = false;
  int iterations = 0;                        // over all rungs tried
  double momentum = 0, continuity = 0;       // recomputed, relative
  double residual = 0;                       // the larger of the two
  double mismatch = 0;                       // |part of q no velocity can reach| / |q|
  std::string used;                          // the last rung
  std::vector<std::string> failed_attempts;  // one line a rung that failed

  void set(double of_momentum, double of_continuity);
};

class SaddlePreconditioner;

// Solves with one F, G, D, J, several times, H changing from solve to solve. What is built for them is kept.
class SaddleSolver {
 public:
  // Keeps references to what `system` refers to. Collective. Throws Error(machine) for more rows than hypre can index.
  SaddleSolver(const SaddleSystem& system, const SaddleOptions& options, const Communicator& ranks);
  ~SaddleSolver();

  // From the initial u, v, p. q is made compatible first, p keeps out of the null space. `flux_scale` 0 stands for the
  // fluxes that would flow without the constraint. Preconditioned GMRES or MINRES, then the rungs of the ladder; never
  // returns a result whose recomputed residual was not checked. Collective.
  [[nodiscard]] SaddleReport solve(const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g, const Vector& q,
                                   Vector& u, Eigen::VectorXd& v, Vector& p, double flux_scale = 0);
  // Without the constraint: [F G; G' H] (u, v) = (f, g) by preconditioned conjugate gradients. Collective.
  [[nodiscard]] SaddleReport solve_viscous(const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g, Vector& u,
                                           Eigen::VectorXd& v);

  // Closed components of A that bodies feel: their mean pressure is what H and J decide.
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
  CoupledSystem coupled_;  // the null space of p
  std::vector<std::pair<std::string, std::unique_ptr<SaddlePreconditioner>>> built_;
};

}  // namespace seiche
