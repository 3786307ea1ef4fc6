#pragma once
// Regions of the grid on which bodies act, and a colouring of bodies whose regions do not overlap.
#include <array>
#include <vector>

#include "linalg/core/block_columns.h"
#include "linalg/core/linear_system.h"

namespace seiche {

// Cells lower <= i < upper of the whole grid; indices wrap around along periodic axes.
struct CellRange {
  std::array<int, 3> lower, upper;
  std::array<int, 3> period{0, 0, 0};  // cells along a periodic axis, else 0
  bool empty() const;
  int width(int axis) const { return upper[axis] - lower[axis]; }
  // Number of cells from the range's lower end to `cell`; negative below it (axis not periodic).
  int offset(int axis, int cell) const;
  // True if the range covers a whole periodic axis.
  bool wraps(int axis) const { return period[axis] > 0 && width(axis) >= period[axis]; }
  bool contains(const std::array<int, 3>& cell) const;
  CellRange grown(int n) const;
  bool meets(const CellRange& other) const;
  // Square of the distance between ranges that do not overlap, cells^2; else 0.
  int squared_distance(const CellRange& other) const;
};

// Cell of each local row. Rows of enclosed air have none: has_place() is false and no range contains them.
std::vector<std::array<int, 3>> cells_of_rows(const LinearSystem& A);
bool has_place(const std::array<int, 3>& cell);

// Local rows whose cells lie in the range, ascending.
std::vector<int> rows_in(const CellRange& range, const RowGrid& grid);

// Bounding range of the rows of each block, over all ranks. Collective.
std::vector<CellRange> ranges_of_blocks(const BlockColumns& J, const std::vector<std::array<int, 3>>& cells,
                                        const std::array<int, 3>& period, const Communicator& ranks);

// Flags the ranges in which A couples some cell to a row without a cell. Collective.
std::vector<char> reaching_placeless(const LinearSystem& A, const std::vector<std::array<int, 3>>& cells,
                                     const std::vector<CellRange>& ranges);

// Colours 0, 1, ... such that ranges of one colour do not overlap, are at least `distance` apart, and at most one of
// them has `apart` set. Greedy, in the given order.
std::vector<int> color(const std::vector<CellRange>& ranges, const std::vector<char>& apart, int distance = 0);

}  // namespace seiche
