#pragma once
// Boxes of elastic or prescribed solids, for tests of pins and surface patches.
#include "base/scene.h"

namespace seiche::test {

inline SolidSpec box(SolidKind kind, const Vec3& lower, const Vec3& upper) {
  SolidSpec s;
  s.name = kind == SolidKind::elastic ? "wall" : "plate";
  s.kind = kind;
  s.shape.kind = "box";
  s.shape.where = "test";
  s.shape.lower = lower;
  s.shape.upper = upper;
  s.rigid.density = 1000;
  s.elastic.youngs_modulus = 1e5;
  s.elastic.poisson_ratio = 0.4;
  s.elastic.element_size = 0.1;
  return s;
}

}  // namespace seiche::test
