#include "linalg/body_regions.h"

#include <algorithm>

namespace seiche {

bool CellRange::empty() const {
  for (int a = 0; a < 3; ++a)
    if (lower[a] >= upper[a]) return true;
  return false;
}

bool CellRange::contains(const std::array<int, 3>& cell) const {
  for (int a = 0; a < 3; ++a)
    if (cell[a] < lower[a] || cell[a] >= upper[a]) return false;
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
  for (int a = 0; a < 3; ++a)
    if (lower[a] >= other.upper[a] || other.lower[a] >= upper[a]) return false;
  return true;
}

std::vector<std::array<int, 3>> cells_of_rows(const LinearSystem& A) {
  const RowGrid& grid = A.grid();
  std::vector<std::array<int, 3>> cells(A.rows(), std::array<int, 3>{0, 0, 0});
  std::size_t n = 0;
  for (int k = grid.lower[2]; k < grid.upper[2]; ++k)
    for (int j = grid.lower[1]; j < grid.upper[1]; ++j)
      for (int i = grid.lower[0]; i < grid.upper[0] && n < grid.row_of_cell.size(); ++i, ++n)
        if (grid.row_of_cell[n] >= 0) cells[grid.row_of_cell[n]] = {i, j, k};
  return cells;
}

std::vector<CellRange> ranges_of_blocks(const BlockColumns& J, const std::vector<std::array<int, 3>>& cells,
                                        const Communicator& ranks) {
  constexpr int far = 1 << 30;  // no cell index
  std::vector<CellRange> ranges(J.blocks.size(), CellRange{{far, far, far}, {-far, -far, -far}});
  for (std::size_t b = 0; b < ranges.size(); ++b)
    for (const int row : J.blocks[b].row)
      for (int a = 0; a < 3; ++a) {
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

std::vector<int> color(const std::vector<CellRange>& ranges) {
  std::vector<int> colors;
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    std::vector<char> taken(b + 1, 0);
    for (std::size_t other = 0; other < b; ++other)
      if (ranges[b].meets(ranges[other])) taken[colors[other]] = 1;
    colors.push_back(int(std::find(taken.begin(), taken.end(), 0) - taken.begin()));
  }
  return colors;
}

}  // namespace seiche
