// Surface tension and contact angles in scene files.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "unit/scene/common.h"

namespace tension_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

TEST_CASE("surface tension, its scheme and contact angles are read") {
  const Scene plain = parse(small_scene);
  CHECK(plain.liquid.surface_tension == 0);
  CHECK(plain.liquid.contact_angle == 90);
  CHECK(plain.liquid.tension_scheme == TensionScheme::explicit_steps);
  const std::string ball = "[[solid]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n";
  const Scene scene = parse(small_scene + "[liquid]\nsurface_tension = 0.072\ncontact_angle = 60\n" +
                            "surface_tension_scheme = \"semi_implicit\"\n" + ball + "contact_angle = 120\n" + ball);
  CHECK(scene.liquid.surface_tension == 0.072);
  CHECK(scene.liquid.contact_angle == 60);
  CHECK(scene.liquid.tension_scheme == TensionScheme::semi_implicit);
  CHECK(scene.solids[0].contact_angle == 120);
  CHECK(!scene.solids[1].contact_angle);
}

TEST_CASE("surface tension and contact angles out of bounds are refused") {
  CHECK_THAT(fault(small_scene + "[liquid]\nsurface_tension = -1\n"), Contains("surface_tension"));
  CHECK_THAT(fault(small_scene + "[liquid]\ncontact_angle = 5\n"), Contains("contact_angle") && Contains("20"));
  CHECK_THAT(fault(small_scene + "[liquid]\ncontact_angel = 60\n"), Contains("did you mean 'contact_angle'"));
  CHECK_THAT(fault(small_scene + "[liquid]\nsurface_tension_scheme = \"implicit\"\n"), Contains("semi_implicit"));
}

}  // namespace tension_tests
