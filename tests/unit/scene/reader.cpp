#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <clocale>
#include <locale>

#include "base/gravity.h"
#include "base/scene.h"
#include "unit/scene/common.h"

namespace reader_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a full scene is read as it is written") {
  const Scene s = parse(rich_scene(3, "sphere", "inflow", "pressure"));
  CHECK(s.title == "rich \"scene\"");
  CHECK(Gravity(s.gravity).at(0) == Vec3(0, -9.81, 1));
  CHECK(s.domain.cells == std::array{8, 16, 8});
  CHECK(s.domain.sides[0][0].type == SideType::inflow);
  CHECK(s.domain.sides[0][0].velocity[0] == "y*(1-y)");
  CHECK(s.domain.sides[0][1].type == SideType::outflow);
  CHECK(s.domain.sides[1][0].type == SideType::no_slip);
  CHECK(s.domain.sides[2][1].type == SideType::free_slip);
  CHECK(s.time.fixed_step == 0.005);
  CHECK(s.time.scheme == TimeScheme::first_order);
  CHECK(s.liquid.density == 998.2);
  REQUIRE(s.liquid.regions.size() == 2);
  CHECK(s.liquid.regions[0].velocity.has_value());
  CHECK(!s.liquid.regions[1].velocity.has_value());
  CHECK(s.liquid.regions[0].shape.radius == 0.25);
  CHECK(s.liquid.regions[0].shape.transform.scale == 1.5);
  CHECK(s.liquid.sources.at(0).from == 0.5);
  CHECK(s.liquid.sources.at(0).until == 1.5);
  CHECK(s.liquid.separates);
  REQUIRE(s.solids.size() == 5);
  CHECK(s.solids[0].slip == Slip::no_slip);
  CHECK(s.solids[1].name == "solid2");
  CHECK(s.solids[1].kind == SolidKind::kinematic);
  CHECK(s.solids[1].motion.degrees == "90*t");
  CHECK(s.solids[2].kind == SolidKind::rigid);
  CHECK(s.solids[2].rigid.density == 400);
  CHECK(s.solids[2].friction == 0.3);
  CHECK(s.solids[4].kind.name == std::string("sprung"));
  CHECK(s.solids[4].numbers.at("spring_stiffness") == 50);
  CHECK(s.solids[4].numbers.at("spring_damping") == 0.5);
  CHECK_THAT(s.solids[1].shape.where, StartsWith("scene.toml:"));
  CHECK(s.probes.at(0).every == 0.01);
  CHECK(s.solver.tolerance == 1e-9);
  CHECK(s.output.frames == std::vector<std::string>{"surface", "viscosity"});
}

TEST_CASE("what is not said has the documented default") {
  const Scene s = parse(small_scene);
  CHECK(s.dimension == 3);
  CHECK(Gravity(s.gravity).at(0) == Vec3(0, -9.81, 0));
  CHECK(s.domain.lower == Vec3(0, 0, 0));
  CHECK(s.time.frame_rate == 24);
  CHECK(s.liquid.density == 1000);
  CHECK(s.solids.empty());
  CHECK(s.output.formats == std::vector<std::string>{"vdb"});
}

TEST_CASE("2D scenes have vectors of two components, the third zero") {
  const Scene s =
      parse("dimension = 2\ngravity = [1, 2]\n[domain]\nupper = [1, 2]\ncell_size = 0.5\n[time]\nend = 1\n");
  CHECK(Gravity(s.gravity).at(0) == Vec3(1, 2, 0));
  CHECK(s.domain.upper == Vec3(1, 2, 0));
  CHECK(s.domain.cells == std::array{2, 4, 1});
}

TEST_CASE("byte order mark and CRLF are read as plain text") {
  std::string crlf = "\xef\xbb\xbf";
  for (const char c : small_scene) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(write_scene(parse(crlf)) == write_scene(parse(small_scene)));
}

TEST_CASE("overrides set numbers, bare words, formulas, array entries and new keys") {
  const std::string text = rich_scene(3, "sphere", "inflow", "pressure");
  const Scene s = parse(text, {{"solid.0.radius", "0.3"},
                               {"solid.0.slip", "free_slip"},
                               {"solid.1.motion.rotate.degrees", "45*t"},
                               {"gravity.1", "-1"},
                               {"title", "two words"},
                               {"domain.boundary.z_lower.type", "no_slip"},
                               {"output.frames", "[\"surface\"]"}});
  CHECK(s.solids[0].shape.radius == 0.3);
  CHECK(s.solids[0].slip == Slip::free_slip);
  CHECK(s.solids[1].motion.degrees == "45*t");
  CHECK(Gravity(s.gravity).at(0) == Vec3(0, -1, 1));
  CHECK(s.title == "two words");
  CHECK(s.domain.sides[2][0].type == SideType::no_slip);
  CHECK(s.output.frames == std::vector<std::string>{"surface"});
  CHECK(parse_override("a.b=c=d").path == "a.b");
  CHECK(parse_override("a.b=c=d").value == "c=d");
  CHECK_THROWS_AS(parse_override("a.b"), Error);
}

TEST_CASE("faults in overrides name the override") {
  const std::vector<std::pair<Override, std::string>> cases{
      {{"liquid.densty", "3"}, "--set liquid.densty: unknown key 'densty' in [liquid]; did you mean 'density'?"},
      {{"time.end.x", "3"}, "--set time.end.x: time.end is 1, not a table"},
      {{"solid.7.radius", "3"}, "--set solid.7.radius"},
      {{"time.end", "[1"}, "--set time.end: '[1' is not a TOML value"},
      {{"time.end", "1\n[x]"}, "--set time.end"},
      {{"time.end", "soon"}, "--set time.end: time.end must be a number (s), not the text \"soon\""},
      {{"time..end", "1"}, "--set time..end: the path must look like key.path"},
      {{"time.end", ""}, "--set time.end"}};
  for (const auto& [override, expected] : cases) CHECK_THAT(fault(small_scene, {override}), StartsWith(expected));
}

TEST_CASE("all faults of a scene are told in one go, in the order of the file") {
  const std::string text =
      "[domain]\nupper = [1, 1]\ncell_size = 0.125\n[time]\nend = \"soon\"\n[liquid]\ndensty = 1\n";
  const std::string message = fault(text, {{"time.cfl", "-1"}});
  CHECK(count_lines(message) == 4);
  CHECK_THAT(
      message,
      StartsWith(
          "scene.toml:2: domain.upper must have 3 components (dimension = 3), not 2\n"
          "scene.toml:5: time.end must be a number (s), not the text \"soon\"; it has \"soon\", which is no parameter\n"
          "scene.toml:7: unknown key 'densty' in [liquid]; did you mean 'density'?"));
  CHECK_THAT(message, Contains("\n--set time.cfl: time.cfl must be > 0 and <= 8; it is -1"));
}

namespace {

class DecimalComma : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

// The C++ locale replaces locales that the machine lacks; the C locale is set too if it is installed.
TEST_CASE("numbers and formulas mean the same under a locale with decimal commas") {
  const std::string text = rich_scene(3, "expression", "inflow", "pressure") +
                           "[[solid]]\nshape = \"plane\"\n"
                           "point = [1234.5, 0, 0]\nnormal = [0.5, 1e-3, 0]\n";
  const std::string expected = write_scene(parse(text));
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  const std::string under_comma = write_scene(parse(text));
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  CHECK(under_comma == expected);
}

}  // namespace reader_tests
