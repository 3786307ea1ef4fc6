// Copies of solids, materials by name, and rotations in their forms.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "base/scene.h"
#include "scene/materials.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace copies_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

std::string ball(const std::string& more, const std::string& kind = "rigid") {
  return small_scene + "[[solid]]\nname = \"ball\"\nkind = \"" + kind +
         "\"\nshape = \"sphere\"\ncenter = [0.1, 0.1, 0.1]\nradius = 0.05\n" + more;
}

Eigen::Matrix3d matrix(const RotationSpec& rotation) {
  return Eigen::AngleAxisd(rotation.degrees * M_PI / 180, rotation.axis.normalized()).toRotationMatrix();
}

Eigen::Matrix3d rotated(const std::string& rotate) {
  return matrix(parse(ball("density = 500\nrotate = { " + rotate + " }\n")).solids[0].shape.transform.rotate);
}

// The middle of the ball as placed.
Vec3 place(const SolidSpec& solid) {
  const TransformSpec& t = solid.shape.transform;
  return t.translate + matrix(t.rotate) * (t.scale * solid.shape.center);
}

}  // namespace

TEST_CASE("an array makes copies in the order of the axes, and the scene that is written stands alone") {
  const Scene scene = parse(
      ball("density = 500\narray = { count = [3, 2, 1], spacing = [0.2, 0.15, 9] }\n") +
      "[[solid]]\nname = \"other\"\nkind = \"static\"\nshape = \"sphere\"\ncenter = [0.9, 0.9, 0.9]\nradius = 0.05\n");
  REQUIRE(scene.solids.size() == 7);
  CHECK(scene.solids[0].name == "ball-1");
  CHECK(scene.solids[1].name == "other");
  CHECK(scene.solids[2].name == "ball-2");
  CHECK((place(scene.solids[2]) - Vec3(0.3, 0.1, 0.1)).norm() < 1e-15);
  CHECK((place(scene.solids[6]) - Vec3(0.5, 0.25, 0.1)).norm() < 1e-15);
  CHECK(write_scene(parse(write_scene(scene))) == write_scene(scene));
}

TEST_CASE("copies in 2D are written as they may be read") {
  for (const std::string rotate : {"", "rotate = { degrees = 30 }\n", "rotate = { degrees = -30 }\n"}) {
    const Scene scene = parse(
        "dimension = 2\n[domain]\nlower = [0, 0]\nupper = [1, 1]\ncell_size = 0.1\n[[solid]]\nname = \"box\"\n"
        "kind = \"rigid\"\nshape = \"box\"\nlower = [-0.1, -0.1]\nupper = [0.1, 0.1]\ndensity = 500\n"
        "translate = [0.2, 0.2]\narray = { count = [2, 1], spacing = [0.4, 0] }\n" +
        rotate + "[time]\nend = 1\n");
    CHECK(write_scene(parse(write_scene(scene))) == write_scene(scene));
    const RotationSpec turn = scene.solids[1].shape.transform.rotate;
    CHECK(turn.axis == Vec3(0, 0, 1));
    CHECK(turn.degrees == Approx(rotate.empty() ? 0 : rotate.find('-') == std::string::npos ? 30 : -30));
  }
}

TEST_CASE("scattered copies keep apart within their box, and the same seed gives the same places") {
  const auto scattered = [](int seed) {
    return parse(
        ball("density = 500\nscatter = { count = 20, lower = [0, 0.2, 0], upper = [1, 0.8, 1], gap = 0.02, "
             "turned = true, seed = " +
             std::to_string(seed) + " }\n"));
  };
  const Scene one = scattered(1);
  REQUIRE(one.solids.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    const Vec3 x = place(one.solids[i]);
    CHECK((x - Vec3(0.05, 0.25, 0.05)).minCoeff() >= -1e-12);
    CHECK((Vec3(0.95, 0.75, 0.95) - x).minCoeff() >= -1e-12);
    for (std::size_t j = 0; j < i; ++j) CHECK((x - place(one.solids[j])).norm() >= 0.12 - 1e-12);
  }
  CHECK(write_scene(one) == write_scene(scattered(1)));
  CHECK(write_scene(one) != write_scene(scattered(2)));
}

TEST_CASE("copies that cannot be are refused with what would be right") {
  const std::string box = "lower = [0, 0, 0], upper = [1, 1, 1]";
  CHECK_THROWS_WITH(parse(ball("density = 500\nscatter = { count = 5000, " + box + " }\n")),
                    Contains("do not find room"));
  CHECK_THROWS_WITH(parse(ball("density = 500\narray = { count = [1.5, 1, 1], spacing = [1, 1, 1] }\n")),
                    Contains("whole numbers"));
  CHECK_THROWS_WITH(parse(ball("density = 500\narray = { count = [2, 1, 1], spacing = [1, 1, 1] }\nscatter = { count = "
                               "2, " +
                               box + " }\n")),
                    Contains("not both"));
  CHECK_THROWS_WITH(parse(ball("density = 500\nscatter = { count = 2, lower = [0, 0, 0], upper = [1, 0.05, 1] }\n")),
                    Contains("narrower than a copy along y"));
  CHECK_THROWS_WITH(
      parse(ball("density = 500\narray = { count = [2, 1, 1], spacing = [0.2, 0, 0] }\n") +
            "[[solid]]\nname = \"ball-2\"\nkind = \"static\"\nshape = \"sphere\"\ncenter = [0.9, 0.9, 0.9]\n"
            "radius = 0.05\n"),
      Contains("two solids \"ball-2\""));
}

TEST_CASE("materials stand for their numbers, which other keys override") {
  const Scene oak = parse(ball("material = \"oak\"\n"));
  CHECK(oak.solids[0].rigid.density == 680);
  CHECK(parse(ball("material = \"oak\"\ndensity = 700\n")).solids[0].rigid.density == 700);
  const std::string elements = "element_size = 0.02\n";
  const Scene soft = parse(ball("material = \"rubber\"\n" + elements, "elastic"));
  CHECK(soft.solids[0].elastic.youngs_modulus == 2e6);
  CHECK(soft.solids[0].rigid.density == 930);
  const Scene damped =
      parse(ball("material = { name = \"rubber\", damping = 0.01, youngs_modulus = 1e6 }\n" + elements, "elastic"));
  CHECK(damped.solids[0].elastic.youngs_modulus == 1e6);
  CHECK(damped.solids[0].elastic.poisson_ratio == 0.49);
  CHECK(damped.solids[0].elastic.damping == 0.01);
  const Scene honey = parse(small_scene, {{"liquid.material", "honey"}, {"liquid.surface_tension", "0"}});
  CHECK(honey.liquid.viscosity == "10.0");
  CHECK(honey.liquid.surface_tension == 0);
  CHECK(parse(small_scene, {{"gas.material", "helium"}}).gas.density == 0.1664);
  CHECK(write_scene(parse(write_scene(honey))) == write_scene(honey));
}

TEST_CASE("materials that are not known are refused, with the nearest name") {
  CHECK_THROWS_WITH(parse(small_scene, {{"liquid.material", "watr"}}), Contains("did you mean 'water'?"));
  CHECK_THROWS_WITH(parse(small_scene, {{"liquid.material", "steel"}}), Contains("known are"));
  CHECK_THROWS_WITH(parse(small_scene, {{"liquid.material", "7"}}), Contains("liquid.material"));
  CHECK_THROWS_WITH(parse(ball("material = \"oak\"\nelement_size = 0.02\n", "elastic")),
                    Contains("of 'oak' only the density is known"));
}

TEST_CASE("docs/materials.md lists the materials with their numbers") {
  std::ifstream in(std::filesystem::path(__FILE__).parent_path() / "../../../docs/materials.md");
  std::ostringstream text;
  text << in.rdbuf();
  for (const NamedMaterial& m : named_materials()) {
    CAPTURE(m.name);
    CHECK_THAT(text.str(), Contains("| `" + std::string(m.name) + "` |"));
    CHECK_THAT(text.str(), Contains(m.source));
  }
}

TEST_CASE("rotations may be Euler angles about fixed axes or quaternions") {
  const Eigen::Matrix3d wanted = (Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.7, Vec3::UnitY()) *
                                  Eigen::AngleAxisd(1.1, Vec3::UnitX()))
                                     .toRotationMatrix();
  const Eigen::Quaterniond q(wanted);
  const auto text = [](double value) { return fmt::format("{:.17g}", value); };
  const double degree = 180 / M_PI;
  CHECK((rotated("euler = [" + text(1.1 * degree) + ", " + text(-0.7 * degree) + ", " + text(0.3 * degree) + "]") -
         wanted)
            .norm() < 1e-14);
  CHECK((rotated("quaternion = [" + text(2 * q.w()) + ", " + text(2 * q.x()) + ", " + text(2 * q.y()) + ", " +
                 text(2 * q.z()) + "]") -
         wanted)
            .norm() < 1e-14);
  CHECK((rotated("axis = [0, 0, 2], degrees = 90") * Vec3::UnitX() - Vec3::UnitY()).norm() < 1e-15);
  CHECK_THROWS_WITH(rotated("axis = [0, 0, 1]"), Contains("degrees"));
  CHECK_THROWS_WITH(rotated("euler = [1, 2, 3], degrees = 4"), Contains("give one of degrees, euler and quaternion"));
  CHECK_THROWS_WITH(rotated("quaternion = [0, 0, 0, 0]"), Contains("must not be zero"));
  CHECK_THROWS_WITH(rotated("quaternion = [1, 0, 0]"), Contains("four numbers"));
}

}  // namespace copies_tests
