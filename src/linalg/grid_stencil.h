#pragma once
// A matrix whose rows couple only neighbouring cells, as coefficients on the cells of the grid's box.
#include <string>
#include <vector>

#include "linalg/linear_system.h"

namespace seiche {

struct GridStencil {
  int dimension = 3;
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0}, periodic{0, 0, 0};  // as in RowGrid
  // Entry 0 is the diagonal, entry 1 + a the coupling to the next cell along axis a; a cell's entries are adjacent,
  // cells run with the first axis fastest. Cells without a row hold a diagonal alone.
  std::vector<double> coefficients;
  int entries() const { return dimension + 1; }
  int cells() const { return int(coefficients.size()) / entries(); }
};

// Either the stencil or why the matrix has none, the same on all ranks. `diagonal_shift` is added, relative, to the
// diagonal in components with a null space. Collective.
struct StencilOrFailure {
  GridStencil stencil;
  std::string failure;
};
StencilOrFailure make_grid_stencil(const LinearSystem& system, double diagonal_shift);

}  // namespace seiche
