#include "base/suggest.h"

#include <algorithm>
#include <array>

namespace seiche {
namespace {

// Letters that the words share at their starts and ends; of these, at their starts.
std::array<std::ptrdiff_t, 2> common_letters(const std::string& a, const std::string& b) {
  const auto start = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin();
  const auto end = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend()).first - a.rbegin();
  return {std::min(start + end, std::ptrdiff_t(std::min(a.size(), b.size()))), start};
}

}  // namespace

// Optimal string alignment (Damerau, Levenshtein), with three rows of the table in memory.
int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = int(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = int(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> suggest(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest_word = 64;  // longer words are not misspelt keys
  if (word.size() > longest_word) return std::nullopt;
  std::optional<std::string> best;
  int best_distance = std::max(1, int(word.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(word, candidate);
    if (distance > best_distance || distance >= int(candidate.size())) continue;
    const bool tied = distance == best_distance;
    if (tied && (!best || common_letters(word, candidate) <= common_letters(word, *best))) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

}  // namespace seiche
