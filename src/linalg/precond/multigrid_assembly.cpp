#include "linalg/precond/multigrid_assembly.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel_range.h"

namespace seiche {
namespace {

// Numbers of cells in a box with a layer around: neighbours, also across periodic sides, tell by their difference.
struct CellNumbers {
  std::array<double, 3> stride, wrap;
  explicit CellNumbers(const CellBox& box, const std::array<int, 3>& periodic) {
    double next = 1;
    for (int a = 0; a < 3; ++a) {
      stride[a] = next;
      wrap[a] = periodic[a] > 0 ? (1 - periodic[a]) * next : 0;
      next *= box.upper[a] - box.lower[a] + 2;
    }
  }
  double of(const std::array<int, 3>& c) const { return c[0] * stride[0] + c[1] * stride[1] + c[2] * stride[2]; }
};

constexpr double nowhere = 1e300;

// visit(row, cell) for this rank's rows on cells.
template <class Visit>
void for_rows_on_cells(const RowGrid& grid, Visit visit) {
  std::size_t next = 0;
  for_each_cell({grid.lower, grid.upper}, [&](const std::array<int, 3>& c) {
    if (const int row = grid.row_of_cell[next++]; row >= 0) visit(row, c);
  });
}

// One entry for each row, then one for each ghost column.
Vector row_numbers(const LinearSystem& system, const CellNumbers& numbers) {
  Vector number(std::size_t(system.rows() + system.halo().ghosts()), nowhere);
  for_rows_on_cells(system.grid(), [&](int row, const auto& c) { number[std::size_t(row)] = numbers.of(c); });
  system.halo().fill_ghosts(number);
  return number;
}

// Enters a row: links to higher cells as c_f, what the diagonal has beyond its links to cells as e. Links to rows that
// are on no cell count as held pressure. False if the row couples cells that are not neighbours.
template <int Dim>
bool enter_row(const LinearSystem& system, const CellNumbers& numbers, const Vector& number, int row,
               StencilRows<Dim>& stencil) {
  const DistributedMatrix& A = system.pattern();
  const auto cell = std::size_t(stencil.place[std::size_t(row)]);
  const double here = number[std::size_t(row)], diagonal = system.diagonal(row);
  double excess = diagonal;
  for (int k = A.row_start[row] + 1; k < A.row_start[row + 1]; ++k) {
    const double value = system.values()[std::size_t(k)];
    const double there = number[std::size_t(system.halo().local_index(A.column[std::size_t(k)]))];
    if (value == 0 || there == nowhere) continue;
    const double step = there - here;
    bool neighbours = false;
    for (int a = 0; a < Dim; ++a) {
      const bool up = step == numbers.stride[a] || (step != 0 && step == numbers.wrap[a]);
      if (up) stencil.face[a][cell] = float(std::max(0.0, -value));
      neighbours = neighbours || up || step == -numbers.stride[a] || (step != 0 && step == -numbers.wrap[a]);
    }
    if (!neighbours) return false;
    excess -= std::max(0.0, -value);
  }
  constexpr double rounding = 1e-12;
  const auto& component = system.null_space().component;
  const bool closed = !component.empty() && component[std::size_t(row)] >= 0;
  stencil.excess[cell] = closed || excess < rounding * diagonal ? 0.0f : float(excess);
  return true;
}

}  // namespace

template <int Dim>
std::string assemble_stencil(const LinearSystem& system, const CellBox& box, StencilRows<Dim>& stencil) {
  for (const int n : system.grid().periodic)
    if (n > 0 && n < 3) return "a periodic axis has fewer than 3 cells";
  if (box.cells() > INT32_MAX / 4) return "too many cells for 32-bit indices";
  CellBox mine;
  for (int a = 0; a < 3; ++a) {
    mine.lower[a] = std::max(box.lower[a], system.grid().lower[a]);
    mine.upper[a] = std::min(box.upper[a], system.grid().upper[a]);
  }
  if (mine.cells() == 0) mine = {{0, 0, 0}, {0, 0, 0}};
  stencil.rows = SplitRows<Dim>(mine);
  stencil.excess.assign(stencil.rows.size(), 0.0f);
  for (auto& field : stencil.face) field.assign(stencil.rows.size(), 0.0f);
  stencil.place.assign(std::size_t(system.rows()), -1);
  const CellNumbers numbers(box, system.grid().periodic);
  const Vector number = row_numbers(system, numbers);
  for_rows_on_cells(system.grid(),
                    [&](int row, const auto& c) { stencil.place[std::size_t(row)] = int(stencil.rows.at(c)); });
  std::atomic<bool> fits = true;
  parallel_pieces(std::size_t(system.rows()), entries_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      if (stencil.place[row] >= 0 && !enter_row(system, numbers, number, int(row), stencil)) fits = false;
  });
  return system.ranks().any(!fits) ? "the matrix couples cells that are not neighbours" : "";
}

template std::string assemble_stencil(const LinearSystem&, const CellBox&, StencilRows<2>&);
template std::string assemble_stencil(const LinearSystem&, const CellBox&, StencilRows<3>&);

}  // namespace seiche
