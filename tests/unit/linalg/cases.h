#pragma once
// Pressure-like systems on boxes of cells. Ranks own slabs across the last axis, so rows have the numbers of a serial
// run for any number of ranks.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/distributed_matrix.h"

namespace seiche::cases {

enum class Kind { liquid, air, wall };  // a row; Dirichlet; Neumann
using Cell = std::array<int, 3>;

struct Poisson {
  int dimension = 3;
  std::array<int, 3> size{1, 1, 1};
  std::array<int, 3> periodic{0, 0, 0};  // 1 along periodic axes
  std::function<Kind(Cell)> kind = [](Cell) { return Kind::liquid; };
  Kind outside = Kind::wall;
  std::function<double(Cell, int)> weight = [](Cell, int) { return 1.0; };  // of the lower face of a cell along an axis
  std::vector<int> cuts{};                                                  // first slab of ranks 1, 2, ..; empty: even
};

struct System {
  DistributedMatrix A;
  RowGrid grid;
  NullSpace null_space;
};

inline std::int64_t index_of(const Poisson& p, Cell c) {
  return c[0] + std::int64_t(p.size[0]) * (c[1] + std::int64_t(p.size[1]) * c[2]);
}

// Neighbour of c (wrapped) and its kind.
inline Kind neighbour(const Poisson& p, Cell& c, int axis, int step) {
  c[axis] += step;
  if (p.periodic[axis]) c[axis] = (c[axis] + p.size[axis]) % p.size[axis];
  return c[axis] < 0 || c[axis] >= p.size[axis] ? p.outside : p.kind(c);
}

template <class Visit>
void for_cells(Cell low, Cell high, Visit visit) {
  for (int k = low[2]; k < high[2]; ++k)
    for (int j = low[1]; j < high[1]; ++j)
      for (int i = low[0]; i < high[0]; ++i) visit(Cell{i, j, k});
}

// Weights of the links to the 2 Dim neighbours.
template <class Visit>
void for_faces(const Poisson& p, Cell c, Visit visit) {
  for (int axis = 0; axis < p.dimension; ++axis) {
    for (const int step : {-1, 1}) {
      Cell n = c;
      const Kind kind = neighbour(p, n, axis, step);
      visit(n, kind, p.weight(step < 0 ? c : n, axis));
    }
  }
}

// Global row number of each cell, or -1.
inline std::vector<std::int64_t> number_rows(const Poisson& p) {
  std::vector<std::int64_t> rows;
  std::int64_t next = 0;
  for_cells({0, 0, 0}, p.size, [&](Cell c) { rows.push_back(p.kind(c) == Kind::liquid ? next++ : -1); });
  return rows;
}

// Components of cells connected by weights > 0; -1 for those with a Dirichlet face.
inline std::vector<int> label_components(const Poisson& p, const std::vector<std::int64_t>& rows, int& count) {
  std::vector<int> label(rows.size(), -2);
  std::vector<Cell> stack;
  count = 0;
  for_cells({0, 0, 0}, p.size, [&](Cell seed) {
    if (rows[index_of(p, seed)] < 0 || label[index_of(p, seed)] != -2) return;
    std::vector<std::int64_t> members;
    bool dirichlet = false;
    stack = {seed};
    label[index_of(p, seed)] = count;
    while (!stack.empty()) {
      const Cell c = stack.back();
      stack.pop_back();
      members.push_back(index_of(p, c));
      for_faces(p, c, [&](Cell n, Kind kind, double w) {
        dirichlet = dirichlet || (kind == Kind::air && w > 0);
        if (kind != Kind::liquid || w <= 0 || label[index_of(p, n)] != -2) return;
        label[index_of(p, n)] = count;
        stack.push_back(n);
      });
    }
    if (dirichlet) {
      for (const auto m : members) label[m] = -1;
    } else {
      ++count;
    }
  });
  return label;
}

inline System build(const Poisson& p, const Communicator& ranks) {
  const int last = p.dimension - 1;
  const auto cut = [&](int rank) {
    if (rank == 0) return 0;
    if (rank == ranks.size()) return p.size[last];
    return p.cuts.empty() ? int(std::int64_t(p.size[last]) * rank / ranks.size())
                          : p.cuts[std::min<std::size_t>(rank - 1, p.cuts.size() - 1)];
  };
  System s;
  s.grid = {p.dimension, {0, 0, 0}, p.size, {0, 0, 0}, {}};
  for (int a = 0; a < p.dimension; ++a) s.grid.periodic[a] = p.periodic[a] ? p.size[a] : 0;
  s.grid.lower[last] = cut(ranks.rank());
  s.grid.upper[last] = cut(ranks.rank() + 1);
  const auto rows = number_rows(p);
  const auto label = label_components(p, rows, s.null_space.count);
  s.A.first_row = -1;
  for_cells({0, 0, 0}, p.size, [&](Cell c) {
    const auto row = rows[index_of(p, c)];
    const bool mine = c[last] >= s.grid.lower[last] && c[last] < s.grid.upper[last];
    s.A.global_rows += row >= 0;
    if (mine) s.grid.row_of_cell.push_back(row >= 0 ? s.A.rows() : -1);
    if (!mine || row < 0) return;
    if (s.A.first_row < 0) s.A.first_row = row;
    const std::size_t diagonal = s.A.value.size();
    s.A.column.push_back(row);
    s.A.value.push_back(0);
    for_faces(p, c, [&](Cell n, Kind kind, double w) {
      if (kind == Kind::wall || w == 0) return;
      s.A.value[diagonal] += w;
      if (kind == Kind::air) return;
      s.A.column.push_back(rows[index_of(p, n)]);
      s.A.value.push_back(-w);
    });
    s.A.row_start.push_back(int(s.A.value.size()));
    s.null_space.component.push_back(label[index_of(p, c)]);
  });
  s.A.first_row = ranks.exclusive_prefix_sum(s.A.rows());
  return s;
}

// A number in (-1, 1) that depends only on its argument: the same on every machine and number of ranks.
inline double noise(std::int64_t n) {
  std::uint64_t h = std::uint64_t(n) * 0x9E3779B97F4A7C15ull + 0x632BE59BD9B4E019ull;
  h = (h ^ (h >> 31)) * 0xBF58476D1CE4E5B9ull;
  h ^= h >> 29;
  return double(h >> 11) / double(1ull << 52) - 1;
}

inline std::vector<double> noise_vector(const DistributedMatrix& A, int seed) {
  std::vector<double> v(A.rows());
  for (int i = 0; i < A.rows(); ++i) v[i] = noise(A.first_row + i + std::int64_t(seed) * 100000007);
  return v;
}

// A dam break after some time: a wavy surface with splashes above it, about half of the box full.
inline Kind splash(const std::array<int, 3>& size, Cell c) {
  const double x = (c[0] + 0.5) / size[0], y = (c[1] + 0.5) / size[1], z = (c[2] + 0.5) / size[2];
  const double height = 0.42 + 0.3 * (x - 0.5) * (x - 0.5) + 0.12 * std::sin(9 * x) * std::cos(7 * z);
  const double dx = x - 0.7, dy = y - 0.8, dz = z - 0.5;
  const bool drop = dx * dx + dy * dy + dz * dz < 0.01;
  const bool pillar = std::abs(x - 0.4) < 0.06 && std::abs(z - 0.5) < 0.1;
  if (pillar) return Kind::wall;
  return y < height || drop ? Kind::liquid : Kind::air;
}

// Face weights for `splash` like those of a ghost-fluid surface (1 / theta, theta >= 0.01) and of cut cells (open
// fractions, some 1e-3). They depend on cell numbers only, and hence not on the number of ranks.
inline double cut_weight(const std::array<int, 3>& size, Cell c, int axis) {
  Cell low = c;
  --low[axis];
  const auto kind = [&](Cell cell) {
    const bool inside = cell[axis] >= 0 && cell[axis] < size[axis];
    return inside ? splash(size, cell) : Kind::wall;
  };
  const Kind a = kind(c), b = kind(low);
  const double random = std::abs(noise(axis + 3 * (c[0] + 1009 * (c[1] + std::int64_t(1009) * c[2]))));
  if ((a == Kind::air) != (b == Kind::air)) return 1 / std::max(0.01, random);
  const double x = (c[0] + 0.5) / size[0], z = (c[2] + 0.5) / size[2];
  const bool near_pillar = std::abs(x - 0.4) < 0.06 + 2.0 / size[0] && std::abs(z - 0.5) < 0.1 + 2.0 / size[2];
  return near_pillar ? std::max(1e-3, random) : 1.0;
}

}  // namespace seiche::cases
