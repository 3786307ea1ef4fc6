// Parameters and units in the numbers of a scene.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/parameters.h"
#include "scene/units.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace parameters_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

// A scene with these lines above its tables, and in its ball.
Scene scene_with(const std::string& parameters, const std::string& ball) {
  const bool moves = ball.find("motion") != std::string::npos;
  return parse(parameters + small_scene + "[[solid]]\nname = \"a\"\nkind = " +
               (moves ? "\"kinematic\"" : "\"static\"") + "\nshape = \"sphere\"\n" + ball);
}

}  // namespace

TEST_CASE("parameters stand for numbers, alone and in expressions and formulas, in any order") {
  const Scene scene = scene_with("[parameters]\nlow = \"depth/2\"\ndepth = 0.4\ncount = 3\n",
                                 "center = [\"depth\", \"low + 0.1\", 0.5]\nradius = \"sqrt(low)/4\"\nmotion = { "
                                 "translate = [\"low*sin(t)\", 0, 0] }\n"
                                 "[output]\ncheckpoint_every = \"2*count\"\n");
  const SolidSpec& ball = scene.solids[0];
  CHECK((ball.shape.center - Vec3(0.4, 0.3, 0.5)).norm() <= 1e-15);
  CHECK(ball.shape.radius == Approx(std::sqrt(0.2) / 4));
  CHECK(ball.motion.translate[0] == "(0.2)*sin(t)");
  CHECK(scene.output.checkpoint_every == 6);
  CHECK(write_scene(parse(write_scene(scene))) == write_scene(scene));  // it stands alone
}

TEST_CASE("an override may set a parameter") {
  const std::string text =
      "[parameters]\nsize = 0.1\n" + small_scene +
      "[[solid]]\nkind = \"static\"\nshape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\nradius = \"2*size\"\n";
  CHECK(parse(text, {{"parameters.size", "0.15"}}).solids[0].shape.radius == Approx(0.3));
}

TEST_CASE("numbers may have units that fit their key") {
  const auto radius = [](const std::string& value) {
    return scene_with("[parameters]\nd = \"40 mm\"\n", "center = [0.5, 0.5, 0.5]\nradius = " + value + "\n")
        .solids[0]
        .shape.radius;
  };
  CHECK(radius("\"20 cm\"") == Approx(0.2));
  CHECK(radius("\"20cm\"") == Approx(0.2));
  CHECK(radius("\"2e2 mm\"") == Approx(0.2));
  CHECK(radius("\"5*d\"") == Approx(0.2));
  CHECK(radius("\"(3+5) in\"") == Approx(0.2032));
  const auto factor = [](const std::string& from, const std::string& to) {
    return *factor_between(*parse_unit(from), to);
  };
  CHECK(factor("g/cm^3", "kg/m^3") == Approx(1000));
  CHECK(factor("rpm", "rad/s or m/s") == Approx(0.10471975512));
  CHECK(factor("deg", "degrees") == Approx(1));
  CHECK(factor("rad", "degrees or m") == Approx(57.295779513));
  CHECK(factor("cm", "degrees or m") == Approx(0.01));
  CHECK(factor("kN m/deg", "N m/rad") == Approx(1000 * 57.295779513));
  CHECK(factor("mPa s", "Pa s") == Approx(1e-3));
  CHECK(factor("l/min", "m^3/s") == Approx(1e-3 / 60));
  CHECK_FALSE(parse_unit("furlong"));
  CHECK_FALSE(parse_unit(""));
  CHECK_FALSE(parse_unit("m^"));
  CHECK_FALSE(factor_between(*parse_unit("kg"), "m"));
}

TEST_CASE("faults of parameters and units are told with the line and what is wanted") {
  const std::string ball = "center = [0.5, 0.5, 0.5]\nradius = 0.1\n";
  const auto refused = [&](const std::string& parameters, const std::string& keys, const std::string& why) {
    INFO(parameters << keys);
    CHECK_THROWS_WITH(scene_with(parameters, keys), Contains(why));
  };
  refused("[parameters]\nsin = 1\n", ball,
          "scene.toml:2: parameters.sin: a parameter's name is a word that formulas do not know");
  refused("[parameters]\nx = 1\n", ball, "a parameter's name is a word");
  refused("[parameters]\na = \"b\"\nb = \"2*a\"\n", ball, "scene.toml:2: parameters.a = \"b\" depends on a parameter");
  refused("[parameters]\na = true\n", ball, "must be a number or an expression");
  refused("[parameters]\na = \"1/0\"\n", ball, "parameters.a: ");
  refused("[parameters]\na = \"30 deg\"\n", ball, "is an angle");
  refused("parameters = 3\n", ball, "written [parameters]");
  refused("", "center = [0.5, 0.5, 0.5]\nradius = \"2 kg\"\n",
          "must be a number (m), not the text \"2 kg\"; it is in kg; it must be in m");
  refused("", "center = [0.5, 0.5, 0.5]\nradius = \"2*size\"\n", "it has \"size\", which is no parameter");
  refused("", "center = [0.5, 0.5, 0.5]\nradius = \"-2 cm\"\n", "solid.0.radius must be");
  refused("", "center = [0.5, 0.5, 0.5]\nradius = \"x\"\n", "solid.0.radius");
}

TEST_CASE("a parameter at fault is reported alone, without those that are built on it") {
  const std::string text =
      "[parameters]\ninner = \"10 cmm\"\nhalf = \"9*inner/4\"\n" + small_scene +
      "[[solid]]\nkind = \"static\"\nshape = \"sphere\"\ncenter = [\"half\", 0, 0]\nradius = \"inner\"\n";
  const std::string message = fault(text);
  CHECK_THAT(message, Contains("parameters.inner"));
  CHECK(count_lines(message) == 1);
}

}  // namespace parameters_tests
