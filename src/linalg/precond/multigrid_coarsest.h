#pragma once
// The exact solve on the coarsest level of multigrid, which every rank holds whole.
#include "linalg/precond/multigrid_level.h"

namespace seiche {

// x = A^+ b: the pseudo-inverse leaves out the constants of components that nothing holds.
template <int Dim>
class CoarsestSolve {
 public:
  CoarsestSolve() = default;
  CoarsestSolve(const MultigridLevel<Dim>& level, const std::vector<float>& excess);
  void apply(MultigridLevel<Dim>& level);

 private:
  std::vector<std::size_t> cell_;
  std::vector<double> inverse_, rhs_;
};

}  // namespace seiche
