#pragma once
// Colour maps by name.
#include <string>

#include "render/image.h"

namespace seiche::render {

struct ColorMap {
  std::string name;
  std::array<Vec3f, 256> colors;  // linear light, from low to high

  // The nearest of them; t is clamped to [0, 1].
  Vec3f at(float t) const;
};

// The map of this name; it stays where it is. Throws Error(bad_input) that lists the names.
const ColorMap& color_map(const std::string& name);
std::vector<std::string> color_map_names();

}  // namespace seiche::render
