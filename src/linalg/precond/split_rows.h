#pragma once
// Storage of the cells of a block on a level of multigrid: row by row along the first axis, the even cells of a row
// before its odd ones. Red and black cells are then contiguous, and so are the neighbours of either.
#include <algorithm>

#include "base/parallel_range.h"
#include "linalg/core/grid_stencil.h"

namespace seiche {

template <int Dim>
struct SplitRows {
  CellBox cells;  // of this rank, by their numbers on the level; one layer of ghosts is stored around them
  int base = 0;   // even; the first cell that a row stores
  int half = 0;   // entries of half a row

  SplitRows() = default;
  explicit SplitRows(const CellBox& own)
      : cells(own), base(even_below(own.lower[0] - 1)), half((own.upper[0] + 2 - base) / 2) {}

  static int even_below(int i) { return i - (i & 1); }
  int extent(int axis) const { return cells.upper[axis] - cells.lower[axis]; }
  bool empty() const { return cells.cells() == 0; }
  // Rows of own cells, and the place of one among all stored rows.
  int own_rows() const { return empty() ? 0 : extent(1) * (Dim == 3 ? extent(2) : 1); }
  int row(int j, int k) const {
    return j - cells.lower[1] + 1 + (Dim == 3 ? (k - cells.lower[2] + 1) * (extent(1) + 2) : 0);
  }
  std::size_t size() const {
    return empty() ? 0 : std::size_t(2) * half * (extent(1) + 2) * (Dim == 3 ? extent(2) + 2 : 1);
  }
  std::size_t row_begin(int j, int k) const { return std::size_t(2) * half * row(j, k); }
  // Entries between a cell and the next one along axis 1 or 2.
  std::size_t stride(int axis) const { return std::size_t(2) * half * (axis == 1 ? 1 : extent(1) + 2); }
  std::size_t at(const std::array<int, 3>& c) const {
    return row_begin(c[1], c[2]) + std::size_t(c[0] & 1) * half + ((c[0] - base) >> 1);
  }
  // The next cell along an axis in the direction +1 or -1; `i` is the cell's number along axis 0.
  std::size_t neighbour(std::size_t cell, int i, int axis, int step) const {
    if (axis > 0) return step > 0 ? cell + stride(axis) : cell - stride(axis);
    if (i & 1) return step > 0 ? cell - half + 1 : cell - half;
    return step > 0 ? cell + half : cell + half - 1;
  }
};

// body(number, j, k) over own rows on all threads.
template <int Dim, class Body>
void for_own_rows(const SplitRows<Dim>& rows, const Body& body) {
  constexpr int cells_a_task = 8192;
  if (rows.empty()) return;
  const auto count = std::size_t(rows.own_rows()), a_task = std::size_t(std::max(1, cells_a_task / rows.extent(0)));
  const auto visit = [&](std::size_t n) {
    body(n, rows.cells.lower[1] + int(n) % rows.extent(1), rows.cells.lower[2] + int(n) / rows.extent(1));
  };
  if (count > a_task) return parallel_range_in_tasks(count, a_task, visit);
  for (std::size_t n = 0; n < count; ++n) visit(n);
}

// visit(cell) over a box, the first axis fastest.
template <class Visit>
void for_each_cell(const CellBox& box, Visit visit) {
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i) visit(std::array<int, 3>{i, j, k});
}

}  // namespace seiche
