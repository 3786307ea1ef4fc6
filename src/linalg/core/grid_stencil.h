#pragma once
// A matrix that couples only neighbouring cells, stored as stencil coefficients on a box of cells.
#include <string>
#include <vector>

#include "linalg/core/linear_system.h"

namespace seiche {

// Cells lower <= i < upper.
struct CellBox {
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  std::int64_t cells() const;
};

// Bounding box of all rows of all ranks; the full extent along periodic axes; empty if some row is not on the grid.
// Collective.
CellBox box_of_rows(const LinearSystem& system);

struct GridStencil {
  int dimension = 3;
  CellBox box;                           // this rank's part of box_of_rows
  std::array<int, 3> periodic{0, 0, 0};  // as in RowGrid
  std::vector<int> row_of_cell;          // of the box; as in RowGrid
  // Entry 0 is the diagonal, entry 1 + a the coupling to the next cell along axis a. Entries of a cell are adjacent;
  // cells run with the first axis fastest. Cells without a row have a diagonal entry only.
  std::vector<double> coefficients;
  int entries() const { return dimension + 1; }
};

// The stencil, or the reason why the matrix has none; the same on all ranks. In components with a null space the
// diagonal is multiplied by 1 + diagonal_shift. Collective.
struct StencilOrFailure {
  GridStencil stencil;
  std::string failure;
};
StencilOrFailure make_grid_stencil(const LinearSystem& system, double diagonal_shift);

}  // namespace seiche
