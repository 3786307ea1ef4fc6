#include "base/name_pattern.h"

#include <algorithm>

namespace seiche {

// Greedy: where the rest does not fit, the last * takes one more character. At most |name| |pattern| comparisons.
bool fits(const std::string& name, const std::string& pattern) {
  constexpr std::size_t none = std::string::npos;
  std::size_t n = 0, p = 0, star = none, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != none) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == none;
}

bool fits_any(const std::string& name, const std::vector<std::string>& patterns) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& p) { return fits(name, p); });
}

bool is_pattern(const std::string& text) {
  return text.find_first_of("*?") != std::string::npos;
}

}  // namespace seiche
