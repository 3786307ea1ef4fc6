#pragma once
// Names given by patterns.
#include <string>
#include <vector>

namespace seiche {

// True if one of the patterns fits the whole name: * stands for any characters, ? for one, all others for themselves.
bool fits_any(const std::string& name, const std::vector<std::string>& patterns);
bool fits(const std::string& name, const std::string& pattern);

// True if the pattern holds * or ?, so that it may fit several names.
bool is_pattern(const std::string& text);

}  // namespace seiche
