#pragma once
// Elastic bodies for the verification tests.
#include "base/solid_spec.h"
#include "scenes.h"

namespace seiche::test {

struct Stiffness {
  double youngs_modulus, poisson_ratio;
};

inline SolidSpec elastic_solid(const std::string& name, double density, const Stiffness& stiffness,
                               double element_size) {
  SolidSpec s;
  s.name = name;
  s.kind = SolidKind::elastic;
  s.shape.where = "test";
  s.rigid.density = density;
  s.elastic.youngs_modulus = stiffness.youngs_modulus;
  s.elastic.poisson_ratio = stiffness.poisson_ratio;
  s.elastic.element_size = element_size;
  return s;
}

inline SolidSpec elastic_box(const std::string& name, const Vec3& lower, const Vec3& upper, double density,
                             const Stiffness& stiffness, double element_size) {
  SolidSpec s = elastic_solid(name, density, stiffness, element_size);
  s.shape.kind = "box";
  s.shape.lower = lower;
  s.shape.upper = upper;
  return s;
}

// Pins the nodes within a box.
inline void pin(SolidSpec& solid, const Vec3& lower, const Vec3& upper) {
  PinSpec p;
  p.shape.kind = "box";
  p.shape.lower = lower;
  p.shape.upper = upper;
  p.shape.where = "test";
  solid.elastic.pinned.push_back(p);
}

}  // namespace seiche::test
