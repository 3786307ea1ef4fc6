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

// Where the rows sit on a structured grid: for solvers that use the grid (PFMG). Local cells lower <= i < upper, first
// axis fastest; row_of_cell is the local row or -1 where the cell carries none.
struct RowGrid {
  int dimension = 3;
  std::array<int, 3> lower{0, 0, 0}, upper{1, 1, 1};
  std::array<int, 3> periodic{0, 0, 0};  // cells along a periodic axis, else 0
  std::vector<int> row_of_cell;
};

// Null spaces: the constant on each of `count` components. component[i] of local row i, or -1 where row i belongs to a
// component with a Dirichlet face.
struct NullSpace {
  int count = 0;
  std::vector<int> component;
};

}  // namespace seiche
