#pragma once
// A matrix whose rows couple only neighbouring cells, as coefficients on the cells of the grid's box.
#include <string>
#include <vector>

#include "linalg/core/linear_system.h"

namespace seiche {

// Cells lower <= i < upper.
struct CellBox {
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  std::int64_t cells() const;
};

// The smallest box around all rows of all ranks; whole along periodic axes; empty where the rows are not on a grid.
// Collective.
CellBox box_of_rows(const LinearSystem& system);

struct GridStencil {
  int dimension = 3;
  CellBox box;                           // this rank's part of box_of_rows
  std::array<int, 3> periodic{0, 0, 0};  // as in RowGrid
  std::vector<int> row_of_cell;          // of the box; as in RowGrid
  // Entry 0 is the diagonal, entry 1 + a the coupling to the next cell along axis a; a cell's entries are adjacent,
  // cells run with the first axis fastest. Cells without a row hold a diagonal alone.
  std::vector<double> coefficients;
  int entries() const { return dimension + 1; }
};

// Either the stencil or why the matrix has none, the same on all ranks. `diagonal_shift` is added, relative, to the
// diagonal in components with a null space. Collective.
struct StencilOrFailure {
  GridStencil stencil;
  std::string failure;
};
StencilOrFailure make_grid_stencil(const LinearSystem& system, double diagonal_shift);

}  // namespace seiche
