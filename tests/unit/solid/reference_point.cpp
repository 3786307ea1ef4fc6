// Reference point of a solid in tables.
#include <catch2/catch.hpp>

#include "base/solid_spec.h"
#include "solid/body/body.h"

namespace reference_point_tests {
using namespace seiche;

namespace {

template <int Dim>
Vec3 reference(const SolidSpec& spec) {
  const Vec<Dim> lower = Vec<Dim>::Zero(), upper = Vec<Dim>::Ones();
  return Body<Dim>(spec, {1.0 / 64, nullptr}, lower, upper).reference_point();
}

SolidSpec formula(SolidKind kind, const std::string& phi) {
  SolidSpec spec;
  spec.name = "s";
  spec.kind = kind;
  spec.shape.kind = "expression";
  spec.shape.phi = phi;
  spec.rigid.density = 500;
  return spec;
}

}  // namespace

TEST_CASE("solids given by a formula report their centre of mass, whatever moves them") {
  const Vec3 center(0.3, 0.6, 0);
  for (const SolidKind kind : {SolidKind::fixed, SolidKind::kinematic, SolidKind::rigid})
    CHECK((reference<2>(formula(kind, "sqrt((x-0.3)^2+(y-0.6)^2)-0.1")) - center).norm() < 1e-3);
  const Vec3 in_space(0.3, 0.6, 0.4);
  CHECK((reference<3>(formula(SolidKind::fixed, "sqrt((x-0.3)^2+(y-0.6)^2+(z-0.4)^2)-0.2")) - in_space).norm() < 1e-3);
}

TEST_CASE("an L of two boxes reports the centre of its mass, not of its bounds") {
  // Areas 0.08 at (0.4, 0.2) and 0.04 at (0.25, 0.5).
  const Vec3 l = reference<2>(
      formula(SolidKind::fixed, "min(max(abs(x-0.4)-0.2, abs(y-0.2)-0.1), max(abs(x-0.25)-0.05, abs(y-0.5)-0.2))"));
  CHECK((l - Vec3(0.35, 0.3, 0)).norm() < 0.01);
}

TEST_CASE("planes report their point, containers the centre of their hole") {
  SolidSpec plane;
  plane.kind = SolidKind::fixed;
  plane.shape.kind = "plane";
  plane.shape.point = {0.2, 0.3, 0};
  plane.shape.normal = {0, 1, 0};
  CHECK(reference<2>(plane) == Vec3(0.2, 0.3, 0));
  SolidSpec vessel;
  vessel.kind = SolidKind::fixed;
  vessel.shape.kind = "box";
  vessel.shape.lower = {0.1, 0.1, 0};
  vessel.shape.upper = {0.9, 0.5, 0};
  vessel.shape.invert = true;
  CHECK((reference<2>(vessel) - Vec3(0.5, 0.3, 0)).norm() < 1e-12);
}

}  // namespace reference_point_tests
