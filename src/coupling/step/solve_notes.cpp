#include "coupling/step/solve_notes.h"

#include <fmt/format.h>

namespace seiche {

std::string note_on_separation(std::int64_t step, double error) {
  if (error == 0) return {};
  return fmt::format(
      "step {}: the search for cells where liquid separates from solids did not converge; the step uses the best set "
      "found, with an error of {:.1e} of the largest pressure (summary.json counts further ones)",
      step, error);
}

std::string note_on_rounding(std::int64_t step, const SolveReport& solve, double tolerance) {
  if (solve.rounding == 0) return {};
  return fmt::format(
      "step {}: solver.tolerance = {:.3g} is below the round-off of the pressures, which leaves a residual of {:.1e}; "
      "{:.1e} gives the same result sooner (stats.csv has the residuals of all steps)",
      step, tolerance, solve.residual, 2 * solve.rounding);
}

template <int Dim>
std::string note_on_rheology(std::int64_t step, const Attempt<Dim>& attempt) {
  if (attempt.rheology_change == 0) return {};
  return fmt::format(
      "step {}: viscosity and flow do not agree after {} solves: the last one changed velocity by {:.1e} of the "
      "largest ({}); further steps like this one are not reported",
      step, attempt.rheology_iterations, attempt.rheology_change,
      attempt.friction_settled ? "solver.rheology_tolerance, rheology_iterations" : "friction did not settle");
}

template std::string note_on_rheology<2>(std::int64_t, const Attempt<2>&);
template std::string note_on_rheology<3>(std::int64_t, const Attempt<3>&);

}  // namespace seiche
