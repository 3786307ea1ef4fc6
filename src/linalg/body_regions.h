#pragma once
// Where bodies act on the grid, and which of them are far enough from each other to be handled at once.
#include <array>
#include <vector>

#include "linalg/block_columns.h"
#include "linalg/linear_system.h"

namespace seiche {

// Cells lower <= i < upper of the whole grid.
struct CellRange {
  std::array<int, 3> lower, upper;
  bool empty() const;
  bool contains(const std::array<int, 3>& cell) const;
  CellRange grown(int n) const;
  bool meets(const CellRange& other) const;
};

// Cell of each of this rank's rows.
std::vector<std::array<int, 3>> cells_of_rows(const LinearSystem& A);

// The cells that each block's rows span, over all ranks. Collective.
std::vector<CellRange> ranges_of_blocks(const BlockColumns& J, const std::vector<std::array<int, 3>>& cells,
                                        const Communicator& ranks);

// Colours 0, 1, ... such that ranges of one colour do not meet; greedy in the order given.
std::vector<int> color(const std::vector<CellRange>& ranges);

}  // namespace seiche
