#pragma once
// Symmetric positive (semi-)definite systems: preconditioned conjugate gradients with a fallback chain.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/distributed_matrix.h"
#include "linalg/spd/coupled_system.h"

namespace seiche {

struct SolveOptions {
  double tolerance = 1e-8;   // of |b - A x| / |b|, 2-norms, recomputed; bounds the divergence of the flow
  int max_iterations = 400;  // of an attempt with a hierarchy; with "none" ten times as many, 2000 at least
  std::string preconditioner = "auto";
  bool jumps = false;  // coefficients differ by orders of magnitude (liquid and gas)
  int fail_first = 0;  // for tests: the first attempts return a wrong x and claim success
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;   // over all attempts
  double residual = 0;  // recomputed |b - A x| / |b|
  double rounding = 0;  // where the residual exceeds the tolerance but not the round-off of x and b in it: that
  std::string used;     // preconditioner of the last attempt
  std::vector<std::string> failed_attempts;  // one line for each failed attempt
  std::int64_t identity_rows = 0;            // rows with a zero diagonal (cells without an open face): x = 0 there
  double mismatch = 0;  // |part of b outside the range| / |b|, e.g. net inflow of closed components
};

class Deflation;
class Preconditioner;

// Solves several systems with one matrix: A x = b, or (A + c J H^-1 J') x = b with a different H each time. Hierarchies
// for A and their products with J are kept.
class SpdSolver {
 public:
  // Copies J; keeps references to the other arguments. Throws Error(machine) for more rows than hypre can index.
  // Collective.
  SpdSolver(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space, BlockColumns J, double c,
            const SolveOptions& options, const Communicator& ranks);
  ~SpdSolver();

  // Solves from the initial x. The part of b outside the range is removed first; x has no part in the null space. Tries
  // the chosen preconditioner, then the other attempts of the chain; the residual of every result is recomputed and
  // checked. An H without rows drops the second term. The tolerance is relative to `scale`, or to |b| if `scale` is 0.
  // A residual within the round-off of x and b counts as converged, since no x is better. Collective.
  [[nodiscard]] SolveReport solve(const BodyMatrix& H, const Vector& b, Vector& x, double scale = 0);

  // Closed components of A that bodies feel: H and J determine their mean pressure.
  const std::vector<int>& sensed_components() const { return system_.sensed_components(); }
  int setup_applications() const;  // applications of preconditioners to columns of J so far
  // Estimate of c J'A^-1 J from below, c (J'Z)(Z'AZ)^-1(Z'J), by the preconditioner used last. Zero before any solve.
  Eigen::MatrixXd added_mass_estimate() const;

 private:
  struct Built;  // a preconditioner, or the reason why there is none
  struct Problem;
  struct Fallback;
  void make(const std::string& name, Built& built) const;
  Built& build(const std::string& name);
  bool is_outdated(const Built& built) const;
  double true_residual(const Problem& problem, const Vector& x) const;
  double rounding_of_residual(const Problem& problem, const Vector& x) const;
  double make_compatible(Vector& b) const;
  std::string choose();
  std::vector<Fallback> make_fallback_chain(const std::string& chosen) const;
  struct Outcome {
    int iterations = 0;
    std::string failure;
  };
  Outcome attempt(const Fallback& fallback, const Problem& problem, Vector& x);
  Outcome iterate(const Fallback& fallback, const Problem& problem, Vector& x);
  void try_fallback_chain(const Problem& problem, Vector& x, SolveReport& report);

  SolveOptions options_;
  BlockColumns J_;
  LinearSystem liquid_;
  CoupledSystem system_;
  std::map<std::string, std::unique_ptr<Built>> built_;
  const Deflation* last_built_ = nullptr;
  // Choices of the first solve for the liquid alone, with bodies, and with bodies that deform. They are kept: a second
  // hierarchy costs more than it saves.
  std::string without_bodies_, with_bodies_, choice_;
};

// Solves A x = b once, as SpdSolver does. Collective.
[[nodiscard]] SolveReport solve_spd(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space,
                                    const std::vector<double>& b, std::vector<double>& x, const SolveOptions& options,
                                    const Communicator& ranks);

}  // namespace seiche
