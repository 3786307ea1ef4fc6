// Prescribed flows in scene files.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace prescribed_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

const std::string swirl = flat_scene + "[liquid]\nprescribed_velocity = [\"0.5-y\", \"cos(t)*x\"]\n";

}  // namespace

TEST_CASE("a prescribed flow is read and written, and there is none unless it is given") {
  const Scene scene = parse(swirl);
  REQUIRE(scene.liquid.prescribed_velocity);
  CHECK(*scene.liquid.prescribed_velocity == VectorFormula{"0.5-y", "cos(t)*x", "0.0"});
  CHECK(parse(write_scene(scene)).liquid.prescribed_velocity == scene.liquid.prescribed_velocity);
  CHECK(!parse(flat_scene).liquid.prescribed_velocity);
  CHECK(write_scene(parse(flat_scene)).find("prescribed_velocity") == std::string::npos);
  CHECK_NOTHROW(parse(swirl + "velocity = [0, \"0\"]\nviscosity = 0\nseparates = false\n"));
}

TEST_CASE("what a prescribed flow would feel nothing of is refused by name") {
  const std::string disc = "shape = \"sphere\"\ncenter = [0, 0]\nradius = 1\n";
  for (const auto& [more, name] : std::vector<std::pair<std::string, std::string>>{
           {"velocity = [1, 0]\n", "liquid.velocity"},
           {"viscosity = 1\n", "liquid.viscosity"},
           {"rheology = { model = \"power_law\", consistency = 1, exponent = 0.5 }\n", "liquid.rheology"},
           {"surface_tension = 0.07\n", "liquid.surface_tension"},
           {"separates = true\n", "liquid.separates"},
           {"[[liquid.region]]\n" + disc + "velocity = [0, 0]\n", "liquid.region.velocity"},
           {"[[liquid.source]]\n" + disc + "velocity = [1, 0]\n", "liquid.source.velocity"},
           {"[gas]\n", "[gas]"},
           {"[[solid]]\n" + disc, "[[solid]]"}}) {
    CHECK_THAT(fault(swirl + more), Contains("liquid.prescribed_velocity: the flow is prescribed and not solved") &&
                                        Contains("so " + name + " would have no effect; remove it"));
  }
  CHECK_THAT(fault(swirl + "separates = true\nviscosity = 1\n"),
             Contains("so liquid.viscosity, liquid.separates would have no effect; remove these"));
  CHECK_THAT(fault(flat_scene + "[liquid]\nprescribed_velocty = [0, 0]\n"),
             Contains("did you mean 'prescribed_velocity'"));
}

}  // namespace prescribed_tests
