#pragma once
// Symmetric positive (semi-)definite systems: preconditioned conjugate gradients with a ladder of preconditioners.
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
  double tolerance = 1e-8;   // of |b - A x| / |b|, 2-norms, recomputed; bounds the divergence left in the flow
  int max_iterations = 400;  // of a rung with a hierarchy; rungs with "none" get ten times as many
  std::string preconditioner = "auto";
  bool jumps = false;  // coefficients differ by orders of magnitude, as those of liquid and gas do
  int fail_first = 0;  // for tests: the first rungs of the ladder return a wrong x and claim success
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;                        // over all rungs tried
  double residual = 0;                       // recomputed |b - A x| / |b|
  std::string used;                          // preconditioner of the last rung
  std::vector<std::string> failed_attempts;  // one line a rung that failed
  std::int64_t identity_rows = 0;            // rows with a zero diagonal (cells with no open face): x = 0 there
  double mismatch = 0;  // |part of b no x can reach| / |b|: net inflow of closed components, for instance
};

class Deflation;
class Preconditioner;

// Solves with one matrix, several times: A x = b, or (A + c J H^-1 J') x = b with H changing from solve to solve. What
// is built for A (hierarchies, J seen through them) is kept.
class SpdSolver {
 public:
  // Takes copies of J, references to the rest. Collective. Throws Error(machine) for more rows than hypre can index.
  SpdSolver(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space, BlockColumns J, double c,
            const SolveOptions& options, const Communicator& ranks);
  ~SpdSolver();

  // From the initial x. b is made compatible first (what no x can reach removed), x keeps out of the null space. Tries
  // the preconditioner asked for, then the rungs of the ladder; never returns a result whose recomputed residual was
  // not checked. H without rows leaves the second term out. The tolerance is relative to `scale`, or to |b| where that
  // is 0.
  [[nodiscard]] SolveReport solve(const BodyMatrix& H, const Vector& b, Vector& x, double scale = 0);

  // Closed components of A that bodies feel: their mean pressure is what H and J decide.
  const std::vector<int>& sensed_components() const { return system_.sensed_components(); }
  int setup_applications() const;  // of preconditioners to columns of J, so far
  // c (J'Z)(Z'AZ)^-1(Z'J): what the preconditioner last used knows of c J'A^-1 J, from below. Zero before any solve.
  Eigen::MatrixXd added_mass_estimate() const;

 private:
  struct Built;  // a preconditioner, or why there is none
  struct Problem;
  struct Fallback;
  void make(const std::string& name, Built& built) const;
  Built& build(const std::string& name);
  bool is_outdated(const Built& built) const;
  double true_residual(const Problem& problem, const Vector& x) const;
  double make_compatible(Vector& b) const;
  std::string choose() const;
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
};

// Solves A x = b once, as SpdSolver does.
[[nodiscard]] SolveReport solve_spd(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space,
                                    const std::vector<double>& b, std::vector<double>& x, const SolveOptions& options,
                                    const Communicator& ranks);

}  // namespace seiche
