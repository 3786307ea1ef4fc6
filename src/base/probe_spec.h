#pragma once
// A [[probe]] of a scene. Plain data in SI units.
#include <optional>
#include <string>

#include "base/vec.h"

namespace seiche {

enum class ProbeKind { pressure, velocity, surface_height, front, displacement };

struct ProbeSpec {
  std::string name;
  ProbeKind kind = ProbeKind::pressure;
  Vec3 position{0, 0, 0};
  std::optional<double> every;  // s; unset: each step
  std::string solid{};          // displacement: the elastic solid; position is one of its points at rest
  std::string where{};          // "scene.toml:14" for messages
};

}  // namespace seiche
