#pragma once
// Where bodies act on the grid, and which of them are far enough from each other to be handled at once.
#include <array>
#include <vector>

#include "linalg/core/block_columns.h"
#include "linalg/core/linear_system.h"

namespace seiche {

// Cells lower <= i < upper of the whole grid; along periodic axes what is beyond one side counts on the other.
struct CellRange {
  std::array<int, 3> lower, upper;
  std::array<int, 3> period{0, 0, 0};  // cells along a periodic axis, else 0
  bool empty() const;
  int width(int axis) const { return upper[axis] - lower[axis]; }
  // Cells from the range's lower end up to a cell; negative below it.
  int offset(int axis, int cell) const;
  // Whether it goes all the way round.
  bool wraps(int axis) const { return period[axis] > 0 && width(axis) >= period[axis]; }
  bool contains(const std::array<int, 3>& cell) const;
  CellRange grown(int n) const;
  bool meets(const CellRange& other) const;
};

// Cell of each of this rank's rows; rows of enclosed air have none, and no range contains them.
std::vector<std::array<int, 3>> cells_of_rows(const LinearSystem& A);
bool has_place(const std::array<int, 3>& cell);

// The cells that each block's rows span, over all ranks. Collective.
std::vector<CellRange> ranges_of_blocks(const BlockColumns& J, const std::vector<std::array<int, 3>>& cells,
                                        const std::array<int, 3>& period, const Communicator& ranks);

// Of each range: whether A couples a cell in it to a row without a place. Collective.
std::vector<char> reaching_placeless(const LinearSystem& A, const std::vector<std::array<int, 3>>& cells,
                                     const std::vector<CellRange>& ranges);

// Colours 0, 1, ... such that ranges of one colour do not meet, and not more than one of them is `apart`; greedy in the
// order given.
std::vector<int> color(const std::vector<CellRange>& ranges, const std::vector<char>& apart);

}  // namespace seiche
