#include "linalg/core/grid_stencil.h"

#include <algorithm>
#include <cstdlib>

namespace seiche {
namespace {

template <class Visit>
void for_cells(const CellBox& box, Visit visit) {
  for (int k = box.lower[2]; k < box.upper[2]; ++k) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j) {
      for (int i = box.lower[0]; i < box.upper[0]; ++i) visit(std::array<int, 3>{i, j, k});
    }
  }
}

// Cell indices of each row and ghost column, one vector an axis.
std::array<Vector, 3> row_coordinates(const LinearSystem& system) {
  const RowGrid& grid = system.grid();
  std::array<Vector, 3> coordinates;
  coordinates.fill(Vector(system.rows() + system.halo().ghosts(), 0.0));
  std::size_t next = 0;
  for_cells({grid.lower, grid.upper}, [&](const std::array<int, 3>& cell) {
    const int row = grid.row_of_cell[next++];
    for (int a = 0; a < 3 && row >= 0; ++a) coordinates[a][row] = cell[a];
  });
  for (Vector& axis : coordinates) system.halo().fill_ghosts(axis);
  return coordinates;
}

// Signed axis (+-1, 2, 3) along which the cells of two rows are neighbours; 0 if they are not.
int neighbour_axis(const std::array<Vector, 3>& x, const std::array<int, 3>& periodic, int row, int column) {
  int axis = 0;
  for (int a = 0; a < 3; ++a) {
    int step = int(x[a][column] - x[a][row]);
    if (periodic[a] > 0 && std::abs(step) == periodic[a] - 1) step = step > 0 ? -1 : 1;
    if (step == 0) continue;
    if (axis != 0 || std::abs(step) > 1) return 0;
    axis = step * (a + 1);
  }
  return axis;
}

// Enters the couplings to higher cells; couplings to lower cells follow by symmetry. False if a nonzero couples cells
// that are not neighbours.
bool fill_couplings(const LinearSystem& system, const std::array<Vector, 3>& x, int row, double* entry) {
  const DistributedMatrix& A = system.pattern();
  for (int k = A.row_start[row] + 1; k < A.row_start[row + 1]; ++k) {
    if (system.values()[k] == 0) continue;
    const int axis = neighbour_axis(x, system.grid().periodic, row, system.halo().local_index(A.column[k]));
    if (axis == 0 || std::abs(axis) > system.grid().dimension) return false;
    if (axis > 0) entry[axis] += system.values()[k];
  }
  return true;
}

bool rows_on_grid(const LinearSystem& system) {
  const RowGrid& grid = system.grid();
  const auto on_grid = std::count_if(grid.row_of_cell.begin(), grid.row_of_cell.end(), [](int r) { return r >= 0; });
  const bool fits = CellBox{grid.lower, grid.upper}.cells() == std::int64_t(grid.row_of_cell.size());
  return !system.ranks().any(!fits || on_grid != system.rows());
}

// The stencil's box and rows on this rank, without coefficients.
GridStencil empty_stencil(const LinearSystem& system, const CellBox& box) {
  const RowGrid& grid = system.grid();
  GridStencil stencil{grid.dimension, {}, grid.periodic, {}, {}};
  for (int a = 0; a < 3; ++a) {
    stencil.box.lower[a] = std::max(box.lower[a], grid.lower[a]);
    stencil.box.upper[a] = std::min(box.upper[a], grid.upper[a]);
  }
  const std::int64_t nx = grid.upper[0] - grid.lower[0], ny = grid.upper[1] - grid.lower[1];
  for_cells(stencil.box, [&](const std::array<int, 3>& c) {
    const auto plane = (c[2] - grid.lower[2]) * ny + (c[1] - grid.lower[1]);
    stencil.row_of_cell.push_back(grid.row_of_cell[plane * nx + (c[0] - grid.lower[0])]);
  });
  return stencil;
}

// False if the matrix couples cells that are not neighbours.
bool fill_coefficients(const LinearSystem& system, double diagonal_shift, double scale, GridStencil& stencil) {
  const std::array<Vector, 3> x = row_coordinates(system);
  const auto& component = system.null_space().component;
  stencil.coefficients.assign(stencil.row_of_cell.size() * stencil.entries(), 0.0);
  bool neighbours_only = true;
  for (std::size_t cell = 0; cell < stencil.row_of_cell.size(); ++cell) {
    double* entry = &stencil.coefficients[cell * stencil.entries()];
    const int row = stencil.row_of_cell[cell];
    entry[0] = row < 0 ? scale : system.diagonal(row);
    if (row < 0) continue;
    if (!component.empty() && component[row] >= 0) entry[0] *= 1 + diagonal_shift;
    neighbours_only = fill_couplings(system, x, row, entry) && neighbours_only;
  }
  return neighbours_only;
}

}  // namespace

std::int64_t CellBox::cells() const {
  std::int64_t count = 1;
  for (int a = 0; a < 3; ++a) count *= std::max(0, upper[a] - lower[a]);
  return count;
}

CellBox box_of_rows(const LinearSystem& system) {
  if (!rows_on_grid(system)) return {};
  const RowGrid& grid = system.grid();
  CellBox box;
  box.lower.fill(INT32_MAX);
  box.upper.fill(INT32_MIN);
  std::size_t next = 0;
  for_cells({grid.lower, grid.upper}, [&](const std::array<int, 3>& cell) {
    if (grid.row_of_cell[next++] < 0) return;
    for (int a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], cell[a]);
      box.upper[a] = std::max(box.upper[a], cell[a] + 1);
    }
  });
  for (int a = 0; a < 3; ++a) {
    box.lower[a] = grid.periodic[a] > 0 ? 0 : int(system.ranks().global_min(double(box.lower[a])));
    box.upper[a] = grid.periodic[a] > 0 ? grid.periodic[a] : int(system.ranks().global_max(double(box.upper[a])));
  }
  return box;
}

StencilOrFailure make_grid_stencil(const LinearSystem& system, double diagonal_shift) {
  const CellBox box = box_of_rows(system);
  if (box.cells() == 0) return {{}, "rows are not on a grid"};
  if (box.cells() > INT32_MAX) return {{}, "more cells than 32 bits count"};
  for (const int n : system.grid().periodic) {
    if (n > 0 && n < 3) return {{}, "a periodic axis has fewer than 3 cells"};
  }
  double scale = 0;  // diagonal entry of cells without a row
  for (int row = 0; row < system.rows(); ++row) scale = std::max(scale, system.diagonal(row));
  GridStencil stencil = empty_stencil(system, box);
  const bool filled = fill_coefficients(system, diagonal_shift, system.ranks().global_max(scale), stencil);
  if (system.ranks().any(!filled)) return {{}, "the matrix couples cells that are not neighbours"};
  return {std::move(stencil), {}};
}

}  // namespace seiche
