#pragma once
// A [[probe]] of a scene. Plain data in SI units.
#include <optional>
#include <string>

#include "base/vec.h"

namespace seiche {

enum class ProbeKind { pressure, velocity, surface_height, front, displacement, joint };
enum class JointQuantity { force, torque, coordinate, power };

struct ProbeSpec {
  std::string name;
  ProbeKind kind = ProbeKind::pressure;
  Vec3 position{0, 0, 0};
  std::optional<double> every;  // s; unset: each step
  std::string solid{};          // displacement: the elastic solid; position is one of its points at rest
  std::string joint{};          // joint: its name
  JointQuantity quantity = JointQuantity::force;
  bool is_vector() const {
    return kind == ProbeKind::velocity || kind == ProbeKind::displacement ||
           (kind == ProbeKind::joint && (quantity == JointQuantity::force || quantity == JointQuantity::torque));
  }
  bool has_position() const { return kind != ProbeKind::front && kind != ProbeKind::joint; }
  std::string where{};  // "scene.toml:14" for messages
};

}  // namespace seiche
