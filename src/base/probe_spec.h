#pragma once
// A [[probe]] of a scene. Plain data in SI units.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"

namespace seiche {

enum class ProbeKind { pressure, velocity, surface_height, front, displacement, joint, flux, volume, force, torque };
enum class JointQuantity { force, torque, coordinate, power };

// Points of one [[probe]] along a line, the ends included, or in a parallelogram, its sides included.
struct ProbeArraySpec {
  std::optional<Vec3> from, to;  // m
  std::optional<int> count;
  std::optional<Vec3> corner, edge_a, edge_b;  // m; edges: from the corner
  std::optional<std::array<double, 2>> counts;
  bool any() const { return from || to || count || corner || edge_a || edge_b || counts; }
};

struct ProbeSpec {
  std::string name;
  ProbeKind kind = ProbeKind::pressure;
  Vec3 position{0, 0, 0};
  ProbeArraySpec array;         // as read; expand_probes() makes probes of it
  std::optional<double> every;  // s; unset: each step
  std::string solid{};          // displacement: the elastic solid; position is one of its points at rest
  std::string joint{};          // joint: its name
  JointQuantity quantity = JointQuantity::force;
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  // volume: a box; flux: a flat one
  std::vector<std::string> solids{};    // force, torque: names, which may hold * and ?
  Vec3 about{0, 0, 0};                  // torque, m
  bool is_vector() const {
    return kind == ProbeKind::velocity || kind == ProbeKind::displacement || sums_loads() ||
           (kind == ProbeKind::joint && (quantity == JointQuantity::force || quantity == JointQuantity::torque));
  }
  bool has_position() const {
    return kind == ProbeKind::pressure || kind == ProbeKind::velocity || kind == ProbeKind::surface_height ||
           kind == ProbeKind::displacement;
  }
  bool has_box() const { return kind == ProbeKind::flux || kind == ProbeKind::volume; }
  bool sums_loads() const { return kind == ProbeKind::force || kind == ProbeKind::torque; }
  std::string where{};  // "scene.toml:14" for messages
};

}  // namespace seiche
