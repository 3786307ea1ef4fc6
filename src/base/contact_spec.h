#pragma once
// A [[contact]] of a scene: how pairs of solids touch. Plain data.
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct ContactSpec {
  std::vector<std::string> between;   // two names with wildcards
  std::optional<double> friction;     // Coulomb's coefficient of the pair; unset: by those of the solids
  std::optional<double> restitution;  // Newton's coefficient of the pair; unset: 0
  bool collide = true;                // false: they pass through each other
  std::string where;                  // file and line
};

}  // namespace seiche
