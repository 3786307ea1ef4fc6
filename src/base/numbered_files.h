#pragma once
// Files that count up.
#include <filesystem>
#include <vector>

namespace seiche {

// `count` files whose names count up from that of the first: the last group of digits in its stem, filled up with zeros
// to its width. Empty if there are no digits.
std::vector<std::filesystem::path> numbered_files(const std::filesystem::path& first, int count);

}  // namespace seiche
