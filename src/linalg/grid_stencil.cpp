#include "linalg/grid_stencil.h"

#include <algorithm>
#include <cstdlib>

namespace seiche {
namespace {

std::int64_t cell_count(const RowGrid& grid) {
  std::int64_t count = 1;
  for (int a = 0; a < 3; ++a) count *= std::max(0, grid.upper[a] - grid.lower[a]);
  return count;
}

// The cell of each row and of each ghost column: one vector an axis.
std::array<Vector, 3> row_coordinates(const LinearSystem& system) {
  const RowGrid& grid = system.grid();
  std::array<Vector, 3> coordinates;
  coordinates.fill(Vector(system.rows() + system.halo().ghosts(), 0.0));
  std::size_t cell = 0;
  for (int k = grid.lower[2]; k < grid.upper[2]; ++k) {
    for (int j = grid.lower[1]; j < grid.upper[1]; ++j) {
      for (int i = grid.lower[0]; i < grid.upper[0]; ++i) {
        const int row = grid.row_of_cell[cell++];
        if (row < 0) continue;
        coordinates[0][row] = i;
        coordinates[1][row] = j;
        coordinates[2][row] = k;
      }
    }
  }
  for (Vector& axis : coordinates) system.halo().fill_ghosts(axis);
  return coordinates;
}

// The signed axis (+-1, 2, 3) along which the cells of two rows are neighbours; 0 if they are not.
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

// Enters the couplings towards higher cells; those towards lower cells are the same by symmetry. False if some pair of
// rows is not a pair of neighbours.
bool fill_couplings(const LinearSystem& system, const std::array<Vector, 3>& x, int row, double* entry) {
  const SparseMatrix& A = system.pattern();
  for (int k = A.row_start[row] + 1; k < A.row_start[row + 1]; ++k) {
    if (system.values()[k] == 0) continue;
    const int axis = neighbour_axis(x, system.grid().periodic, row, system.halo().local_index(A.column[k]));
    if (axis == 0 || std::abs(axis) > system.grid().dimension) return false;
    if (axis > 0) entry[axis] += system.values()[k];
  }
  return true;
}

std::string unusable(const LinearSystem& system) {
  const RowGrid& grid = system.grid();
  const std::int64_t cells = cell_count(grid);
  const auto on_grid = std::count_if(grid.row_of_cell.begin(), grid.row_of_cell.end(), [](int r) { return r >= 0; });
  if (system.ranks().any(cells != std::int64_t(grid.row_of_cell.size()) || on_grid != system.rows())) {
    return "rows are not on a grid";
  }
  const auto narrow = [](int n) { return n > 0 && n < 3; };
  if (std::any_of(grid.periodic.begin(), grid.periodic.end(), narrow)) return "a periodic axis has fewer than 3 cells";
  if (system.ranks().global_sum(cells) > INT32_MAX) return "more cells than 32 bits count";
  return {};
}

}  // namespace

StencilOrFailure make_grid_stencil(const LinearSystem& system, double diagonal_shift) {
  const RowGrid& grid = system.grid();
  if (std::string failure = unusable(system); !failure.empty()) return {{}, failure};
  GridStencil stencil{grid.dimension, grid.lower, grid.upper, grid.periodic, {}};
  double scale = 0;
  for (int row = 0; row < system.rows(); ++row) scale = std::max(scale, system.diagonal(row));
  scale = system.ranks().global_max(scale);
  const std::array<Vector, 3> x = row_coordinates(system);
  const NullSpace& null_space = system.null_space();
  stencil.coefficients.assign(grid.row_of_cell.size() * stencil.entries(), 0.0);
  bool neighbours_only = true;
  for (std::size_t cell = 0; cell < grid.row_of_cell.size(); ++cell) {
    double* entry = &stencil.coefficients[cell * stencil.entries()];
    const int row = grid.row_of_cell[cell];
    entry[0] = row < 0 ? scale : system.diagonal(row);
    if (row < 0) continue;
    if (!null_space.component.empty() && null_space.component[row] >= 0) entry[0] *= 1 + diagonal_shift;
    neighbours_only = fill_couplings(system, x, row, entry) && neighbours_only;
  }
  if (system.ranks().any(!neighbours_only)) return {{}, "the matrix couples cells that are not neighbours"};
  return {std::move(stencil), {}};
}

}  // namespace seiche
