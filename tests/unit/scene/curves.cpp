// Curves of a scene: by points, from CSV files, and their faults.
#include <catch2/catch.hpp>

#include "base/expression.h"
#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace scene_curves_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

std::string with_curve(const std::string& curve) {
  return "[curves]\nlift = " + curve + "\n" + small_scene +
         "[[solid]]\nname = \"gate\"\nkind = \"kinematic\"\nshape = \"box\"\nlower = [0.4, 0.1, 0.1]\nupper = [0.5, "
         "0.6, "
         "0.9]\nmotion = { translate = [0, \"lift(t)\", 0] }\n";
}

double lift_at(const Scene& scene, double t) {
  return Expression(scene.solids[0].motion.translate[1])({0, 0, 0}, t);
}

}  // namespace

TEST_CASE("curves by points drive motions, and the written scene stands alone") {
  const Scene scene =
      parse(with_curve("{ times = [0, 0.5, 1], values = [0, 10, 0], scale = 0.01, interpolate = \"linear\" }"));
  CHECK(lift_at(scene, 0.25) == Approx(0.05));
  const std::string text = write_scene(scene);
  const Scene again = parse(text);
  CHECK(write_scene(again) == text);
  CHECK(lift_at(again, 0.25) == Approx(0.05));
}

TEST_CASE("curves come from columns of CSV files, by name or number") {
  const ScratchFolder scratch;
  scratch.write("m.csv", "t;x;y\n0;5;0\n1;6;0.1\n\n2;7;0.3\n");
  scratch.write("plain.csv", "0,0\n1,0.2\n");
  const auto lift = [&](const std::string& curve) { return lift_at(parse(with_curve(curve), {}, scratch.path()), 1); };
  CHECK(lift("{ file = \"m.csv\", time = \"t\", value = \"y\" }") == Approx(0.1));
  CHECK(lift("{ file = \"m.csv\", value = 3 }") == Approx(0.1));
  CHECK(lift("{ file = \"plain.csv\" }") == Approx(0.2));
}

TEST_CASE("faults of curves name the line and what would be right") {
  const ScratchFolder scratch;
  scratch.write("late.csv", "t,x\n0,0\n2,1\n1,2\n");
  scratch.write("text.csv", "t,x\n0,0\n1,one\n");
  const auto refused = [&](const std::string& curve, const std::string& text) {
    CHECK_THROWS_WITH(parse(with_curve(curve), {}, scratch.path()), Contains("scene.toml:2") && Contains(text));
  };
  refused("{ file = \"late.csv\" }", "late.csv:4: its time 1 does not come after 2; sort the rows");
  refused("{ file = \"text.csv\" }", "text.csv:3: has no numbers");
  refused("{ file = \"late.csv\", value = \"y\" }", "has no such column; its columns are t, x");
  refused("{ file = \"none.csv\" }", "none.csv");
  refused("{ times = [0, 1, 1], values = [0, 1, 2] }", "its time 1 does not come after 1");
  refused("{ times = [0, 1], values = [0] }", "has 2 times and 1 values");
  refused("{ times = [0, 1] }", "needs a file, or times and values");
  refused("{ time = [0, 1], valus = [0, 1] }", "did you mean 'values'?");
  refused("{ times = [0, 1], values = [0, 1], interpolate = \"cubic\" }", "\"smooth\" or \"linear\"");
  refused("7", "must be a table");
  CHECK_THROWS_WITH(parse("[curves]\nsin = { times = [0], values = [0] }\n" + small_scene),
                    Contains("do not know yet"));
  CHECK_THROWS_WITH(
      parse(with_curve("{ times = [0, 1], values = [0, 1] }"), {{"solid.0.motion.translate", "[0, \"lfit(t)\", 0]"}}),
      Contains("did you mean 'lift'?"));
}

}  // namespace scene_curves_tests
