#pragma once
// A distributed sparse matrix in compressed rows. Rank r owns rows [first_row, first_row + rows()).
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace seiche {

using Row = std::int64_t;

struct DistributedMatrix {
  Row first_row = 0;
  Row global_rows = 0;
  std::vector<int> row_start{0};  // size rows() + 1
  std::vector<Row> column;        // global; the diagonal comes first in each row
  std::vector<double> value;
  int rows() const { return int(row_start.size()) - 1; }
};

// Positions of the rows on a structured grid, for solvers that use the grid (PFMG). Local cells lower <= i < upper,
// first axis fastest; row_of_cell is the local row, or -1 for cells without a row.
struct RowGrid {
  int dimension = 3;
  std::array<int, 3> lower{0, 0, 0}, upper{1, 1, 1};
  std::array<int, 3> periodic{0, 0, 0};  // number of cells along a periodic axis, else 0
  std::vector<int> row_of_cell;
};

// Null space: one constant vector for each of `count` components. component[i] is that of local row i, or -1 if its
// component has a Dirichlet face.
struct NullSpace {
  int count = 0;
  std::vector<int> component;
};

}  // namespace seiche
