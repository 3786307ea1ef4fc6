#pragma once
// "Did you mean": finds the known name nearest to a misspelt one.
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// Smallest number of insertions, deletions, substitutions and swaps of neighbours that turns a into b.
int edit_distance(const std::string& a, const std::string& b);

// The candidate nearest to the word, if it is near enough to be a typing error: within a third of the word's length or
// one edit. Among equally near candidates, the one with the longest common prefix.
std::optional<std::string> suggest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace seiche
