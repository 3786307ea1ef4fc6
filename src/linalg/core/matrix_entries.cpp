#include "linalg/core/matrix_entries.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace seiche {

std::vector<MatrixEntry> send_to_owner(const std::vector<MatrixEntry>& mine, Row first, std::size_t count,
                                       const Communicator& ranks) {
  const auto is_home = [&](const MatrixEntry& e) { return e.row >= first && e.row < first + Row(count); };
  std::vector<MatrixEntry> home, away;
  for (const MatrixEntry& e : mine) (is_home(e) ? home : away).push_back(e);
  for (const std::string& part :
       ranks.all_gather(std::string(reinterpret_cast<const char*>(away.data()), away.size() * sizeof(MatrixEntry)))) {
    std::vector<MatrixEntry> theirs(part.size() / sizeof(MatrixEntry));
    if (!part.empty()) std::memcpy(theirs.data(), part.data(), part.size());
    std::copy_if(theirs.begin(), theirs.end(), std::back_inserter(home), is_home);
  }
  std::stable_sort(home.begin(), home.end(), [](const MatrixEntry& a, const MatrixEntry& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
  std::vector<MatrixEntry> merged;
  for (const MatrixEntry& e : home)
    if (!merged.empty() && merged.back().row == e.row && merged.back().column == e.column)
      merged.back().value += e.value;
    else
      merged.push_back(e);
  return merged;
}

std::vector<MatrixEntry> send_sums_to_owner(const std::vector<MatrixEntry>& mine, Row first, std::size_t count,
                                            const Communicator& ranks) {
  constexpr double rounding = 1e-12;  // of up to 1e4 terms
  std::vector<MatrixEntry> sizes = mine;
  for (MatrixEntry& e : sizes) e.value = std::abs(e.value);
  sizes = send_to_owner(sizes, first, count, ranks);
  const std::vector<MatrixEntry> sums = send_to_owner(mine, first, count, ranks);
  std::vector<MatrixEntry> kept;
  for (std::size_t n = 0; n < sums.size(); ++n)
    if (std::abs(sums[n].value) > rounding * sizes[n].value) kept.push_back(sums[n]);
  return kept;
}

}  // namespace seiche
