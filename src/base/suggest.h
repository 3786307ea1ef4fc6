#pragma once
// "Did you mean": the nearest of some names to a misspelt one.
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// Fewest insertions, deletions, substitutions and swaps of neighbours that turn a into b.
int edit_distance(const std::string& a, const std::string& b);

// The candidate nearest to the word, if it is near enough to be a slip (a third of its length, at least one edit). Of
// equally near ones the one that begins most alike.
std::optional<std::string> suggest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace seiche
