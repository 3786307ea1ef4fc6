#pragma once
// The table [curves]: functions of time by points, in the scene or in a CSV file.
#include <map>

#include "base/curves.h"
#include "scene/context.h"
#include "scene/toml.h"

namespace seiche {

// Reads and declares the curves. Reports names that are taken, points out of order, and files that cannot be read, with
// their line.
std::map<std::string, TimeCurve> read_curves(SceneContext& context, const TomlNode& root);

}  // namespace seiche
