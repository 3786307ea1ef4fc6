#include "coupling/state/features.h"
#include "base/scene.h"
#include "coupling/state/setup.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "coupling/step/leapfrog.h"
#include "verification/scenes.h"

namespace features_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

Scene basin() {
  Scene scene = test::box_scene(2, 8);
  test::add_liquid(scene, "y-0.5");
  return scene;
}

SolidSpec box(SolidKind kind, const Vec3& lower, const Vec3& upper) {
  SolidSpec spec;
  spec.name = "block";
  spec.kind = kind;
  spec.shape.kind = "box";
  spec.shape.lower = lower;
  spec.shape.upper = upper;
  spec.rigid.density = 500;
  return spec;
}

std::vector<std::string> told(const Scene& scene) {
  return describe_features(Setup<2>(scene, Communicator()));
}

}  // namespace

TEST_CASE("nothing is told of a scene in which nothing is switched off") {
  CHECK(told(basin()).empty());
  Scene floating = basin();
  floating.solids.push_back(box(SolidKind::rigid, {0.3, 0.3, 0}, {0.7, 0.7, 1}));
  CHECK(told(floating).empty());
  CHECK(may_leapfrog(Setup<2>(floating, Communicator()).features));
}

TEST_CASE("liquid under gas leapfrogs where gravity alone drives its surface") {
  Scene scene = basin();
  scene.gas.present = true;
  scene.gas.density = 1.2;
  scene.gravity = Vec3(0, -9.81, 0);
  CHECK(may_leapfrog(Setup<2>(scene, Communicator()).features));
  scene.liquid.surface_tension = 0.07;
  CHECK_FALSE(may_leapfrog(Setup<2>(scene, Communicator()).features));
  scene.liquid.surface_tension = 0;
  scene.gravity = Vec3::Zero();
  CHECK_FALSE(may_leapfrog(Setup<2>(scene, Communicator()).features));
}

TEST_CASE("gravity by a formula counts as gravity, whatever its values until the end") {
  Scene scene = basin();
  scene.gas.present = true;
  scene.gas.density = 1.2;
  scene.gravity.formula = {"0", "t < 100 ? 0 : -9.81", "0"};
  CHECK(may_leapfrog(Setup<2>(scene, Communicator()).features));
}

TEST_CASE("solids thinner than a cell switch nothing off where no liquid may be") {
  Scene scene = basin();
  scene.liquid.regions.clear();
  scene.solids.push_back(box(SolidKind::rigid, {0.5, 0.1, 0}, {0.52, 0.9, 1}));
  const Setup<2> setup(scene, Communicator());
  CHECK(may_leapfrog(setup.features));
  CHECK(setup.notes.empty());
}

TEST_CASE("what switches the leapfrog off is told, and is what the step looks at") {
  Scene scene = basin();
  scene.solids.push_back(box(SolidKind::fixed, {0.5, 0.1, 0}, {0.52, 0.9, 1}));
  REQUIRE(told(scene).size() == 1);
  CHECK_THAT(told(scene)[0],
             Contains("off: leapfrog of surface and velocity (because of: solids thinner than a cell)"));
  CHECK_FALSE(may_leapfrog(Setup<2>(scene, Communicator()).features));
  scene.time.scheme = TimeScheme::first_order;  // as requested
  CHECK(told(scene).empty());
}

TEST_CASE("contact angles without surface tension are told") {
  Scene scene = basin();
  scene.liquid.contact_angle = 40;
  REQUIRE(told(scene).size() == 1);
  CHECK_THAT(told(scene)[0], Contains("off: contact angles (because of: no surface_tension)"));
  scene.liquid.surface_tension = 0.07;
  CHECK(told(scene).empty());
}

TEST_CASE("surface tension that does not pull on moving solids is told") {
  Scene scene = basin();
  scene.liquid.surface_tension = 0.07;
  CHECK(told(scene).empty());
  scene.solids.push_back(box(SolidKind::rigid, {0.3, 0.3, 0}, {0.7, 0.7, 1}));
  REQUIRE(told(scene).size() == 1);
  CHECK_THAT(told(scene)[0], Contains("off: pull of surface tension on solids"));
}

TEST_CASE("all causes of a scene are told in one line") {
  Scene scene = basin();
  scene.gas.present = true;
  scene.gas.density = 1;
  scene.solids.push_back(box(SolidKind::fixed, {0.5, 0.1, 0}, {0.52, 0.9, 1}));
  CHECK_THAT(told(scene)[0], Contains("[gas] that flows, beside solids") && Contains(", solids thinner than a cell"));
}

TEST_CASE("docs/features.md is what the table says") {
  const auto page = std::filesystem::path(__FILE__).parent_path() / "../../../docs/features.md";
  std::ifstream file(page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto fresh = std::filesystem::temp_directory_path() / "features.md";
  if (text != feature_reference()) std::ofstream(fresh) << feature_reference();
  INFO("the page as it should be: " << fresh.string());
  CHECK(text == feature_reference());
}

}  // namespace features_tests
