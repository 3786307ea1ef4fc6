#include "base/numbered_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace seiche {

std::vector<std::filesystem::path> numbered_files(const std::filesystem::path& first, int count) {
  constexpr std::size_t most_digits = 9;
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const std::string name = first.filename().string(), stem = first.stem().string();
  const auto end = std::find_if(stem.rbegin(), stem.rend(), is_digit).base();
  const auto begin = std::find_if_not(std::make_reverse_iterator(end), stem.rend(), is_digit).base();
  const std::string before(stem.begin(), begin), digits(begin, end),
      after = name.substr(std::size_t(end - stem.begin()));
  if (digits.empty() || digits.size() > most_digits) return {};
  std::vector<std::filesystem::path> files;
  for (int n = 0; n < count; ++n)
    files.push_back(first.parent_path() /
                    fmt::format("{}{:0{}}{}", before, std::stol(digits) + n, digits.size(), after));
  return files;
}

}  // namespace seiche
