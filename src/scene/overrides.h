#pragma once
#include <vector>

#include "scene/reader.h"
#include "scene/toml.h"

namespace seiche {

// Sets the values in the tree; override number n (from 0) gets line -n - 1. Throws Error(bad_input) for paths that do
// not exist and values that are not TOML.
void apply_overrides(TomlNode& root, const std::vector<Override>& overrides);

}  // namespace seiche
