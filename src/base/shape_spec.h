#pragma once
// Shapes of a scene: liquid, solids, sources, pins. Plain data in SI units.
#include <filesystem>
#include <optional>
#include <vector>

#include "base/formula.h"
#include "base/vec.h"

namespace seiche {

struct RotationSpec {
  Vec3 axis{0, 0, 1};
  double degrees = 0;
};

// x -> translate + R (scale x): scale first, then rotate about the origin, then translate.
struct TransformSpec {
  double scale = 1;
  RotationSpec rotate;
  Vec3 translate{0, 0, 0};
};

struct ShapeSpec {
  std::string kind;                     // a name from the table in geometry/shapes/shapes.h
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  // box, height_map
  Vec3 center{0, 0, 0};
  Vec3 from{0, 0, 0}, to{0, 0, 0};
  Vec3 point{0, 0, 0}, normal{0, 1, 0};
  double radius = 0;
  std::filesystem::path file;     // resolved against the scene's folder
  std::vector<Vec3> points;       // polygon: its corners in order
  Formula phi;                    // negative inside
  std::optional<std::string> up;  // height_map: axis of its heights, "y" or "-y"; unset: that against gravity
  bool invert = false;
  TransformSpec transform;
  std::string where;  // "scene.toml:14" for messages

  // True if the scene or its file gives the facets of the surface.
  bool has_facets() const { return kind == "mesh" || kind == "polygon"; }
};

}  // namespace seiche
