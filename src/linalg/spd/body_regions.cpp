#include "linalg/spd/body_regions.h"

#include <algorithm>
#include <limits>

namespace seiche {
namespace {

constexpr int no_place = -(1 << 29);  // below any range

}  // namespace

bool CellRange::empty() const {
  for (int a = 0; a < 3; ++a)
    if (lower[a] >= upper[a]) return true;
  return false;
}

int CellRange::offset(int axis, int cell) const {
  const int n = cell - lower[axis], p = period[axis];
  return p > 0 ? (n % p + p) % p : n;
}

bool CellRange::contains(const std::array<int, 3>& cell) const {
  if (!has_place(cell)) return false;
  for (int a = 0; a < 3; ++a)
    if (const int n = offset(a, cell[a]); n < 0 || n >= width(a)) return false;
  return true;
}

CellRange CellRange::grown(int n) const {
  if (empty()) return *this;
  CellRange r = *this;
  for (int a = 0; a < 3; ++a) r.lower[a] -= n, r.upper[a] += n;
  return r;
}

bool CellRange::meets(const CellRange& other) const {
  if (empty() || other.empty()) return false;
  for (int a = 0; a < 3; ++a) {
    const int ahead = offset(a, other.lower[a]), behind = other.offset(a, lower[a]);
    const bool overlap = (ahead >= 0 && ahead < width(a)) || (behind >= 0 && behind < other.width(a));
    if (!overlap) return false;
  }
  return true;
}

int CellRange::squared_distance(const CellRange& other) const {
  int sum = 0;
  for (int a = 0; a < 3; ++a) {
    const int ahead = offset(a, other.lower[a]), behind = other.offset(a, lower[a]);
    int gap = std::numeric_limits<int>::max();
    if (ahead >= 0) gap = std::min(gap, std::max(0, ahead - width(a)));
    if (behind >= 0) gap = std::min(gap, std::max(0, behind - other.width(a)));
    sum += gap * gap;
  }
  return sum;
}

bool has_place(const std::array<int, 3>& cell) {
  return cell[0] != no_place;
}

std::vector<std::array<int, 3>> cells_of_rows(const LinearSystem& A) {
  const RowGrid& grid = A.grid();
  std::vector<std::array<int, 3>> cells(A.rows(), std::array<int, 3>{no_place, no_place, no_place});
  std::size_t n = 0;
  for (int k = grid.lower[2]; k < grid.upper[2]; ++k)
    for (int j = grid.lower[1]; j < grid.upper[1]; ++j)
      for (int i = grid.lower[0]; i < grid.upper[0] && n < grid.row_of_cell.size(); ++i, ++n)
        if (grid.row_of_cell[n] >= 0) cells[grid.row_of_cell[n]] = {i, j, k};
  return cells;
}

std::vector<int> rows_in(const CellRange& range, const RowGrid& grid) {
  std::array<std::vector<int>, 3> inside;  // offsets from the grid's lower end
  for (int a = 0; a < 3; ++a)
    for (int i = grid.lower[a]; i < grid.upper[a]; ++i)
      if (const int n = range.offset(a, i); n >= 0 && n < range.width(a)) inside[a].push_back(i - grid.lower[a]);
  const int nx = grid.upper[0] - grid.lower[0], ny = grid.upper[1] - grid.lower[1];
  std::vector<int> rows;
  for (const int k : inside[2])
    for (const int j : inside[1])
      for (const int i : inside[0]) {
        const auto cell = std::size_t(i) + std::size_t(nx) * (std::size_t(j) + std::size_t(ny) * std::size_t(k));
        if (cell < grid.row_of_cell.size() && grid.row_of_cell[cell] >= 0) rows.push_back(grid.row_of_cell[cell]);
      }
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::vector<CellRange> ranges_of_blocks(const BlockColumns& J, const std::vector<std::array<int, 3>>& cells,
                                        const std::array<int, 3>& period, const Communicator& ranks) {
  constexpr int far = 1 << 30;  // beyond any cell index
  std::vector<CellRange> ranges(J.blocks.size(), CellRange{{far, far, far}, {-far, -far, -far}, period});
  for (std::size_t b = 0; b < ranges.size(); ++b)
    for (const int row : J.blocks[b].row)
      for (int a = 0; a < 3 && has_place(cells[row]); ++a) {
        ranges[b].lower[a] = std::min(ranges[b].lower[a], cells[row][a]);
        ranges[b].upper[a] = std::max(ranges[b].upper[a], cells[row][a] + 1);
      }
  if (ranks.size() == 1) return ranges;
  const std::string mine(reinterpret_cast<const char*>(ranges.data()), ranges.size() * sizeof(CellRange));
  for (const std::string& part : ranks.all_gather(mine)) {
    const auto* theirs = reinterpret_cast<const CellRange*>(part.data());
    for (std::size_t b = 0; b < ranges.size(); ++b)
      for (int a = 0; a < 3; ++a) {
        ranges[b].lower[a] = std::min(ranges[b].lower[a], theirs[b].lower[a]);
        ranges[b].upper[a] = std::max(ranges[b].upper[a], theirs[b].upper[a]);
      }
  }
  return ranges;
}

// Off-diagonal entries of A have one sign. Hence A times the indicator of rows without a cell is nonzero at every row
// that is coupled to them.
std::vector<char> reaching_placeless(const LinearSystem& A, const std::vector<std::array<int, 3>>& cells,
                                     const std::vector<CellRange>& ranges) {
  Vector placeless(cells.size()), beside(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) placeless[i] = has_place(cells[i]) ? 0 : 1;
  A.multiply(placeless, beside);
  std::vector<double> count(ranges.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t b = 0; b < ranges.size() && beside[i] != 0; ++b) count[b] += ranges[b].contains(cells[i]);
  A.ranks().global_sum(count);
  std::vector<char> reaching;
  for (const double n : count) reaching.push_back(n > 0);
  return reaching;
}

std::vector<int> color(const std::vector<CellRange>& ranges, const std::vector<char>& apart, int distance) {
  const auto conflict = [&](std::size_t b, std::size_t other) {
    if (apart[b] && apart[other]) return true;
    const bool empty = ranges[b].empty() || ranges[other].empty();
    return !empty &&
           (ranges[b].meets(ranges[other]) || ranges[b].squared_distance(ranges[other]) < distance * distance);
  };
  std::vector<int> colors;
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    std::vector<char> taken(b + 1, 0);
    for (std::size_t other = 0; other < b; ++other)
      if (conflict(b, other)) taken[colors[other]] = 1;
    colors.push_back(int(std::find(taken.begin(), taken.end(), 0) - taken.begin()));
  }
  return colors;
}

}  // namespace seiche
