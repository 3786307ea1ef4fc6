// Sources and drains: rates, motions, solids that take them along; height maps among the shapes.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace sources_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

const std::string arm = "[[solid]]\nname = \"arm\"\nshape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\nradius = 0.1\n";
const std::string gate =
    "[[solid]]\nname = \"gate\"\nkind = \"elastic\"\nshape = \"sphere\"\ncenter = [0.2, 0.2, 0.2]\nradius = 0.1\n"
    "density = 1000\nelement_size = 0.05\nmaterial = { youngs_modulus = 1e6, poisson_ratio = 0.3 }\n";

std::string opening(const std::string& list, const std::string& keys) {
  return small_scene + "[[liquid." + list + "]]\nshape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\nradius = 0.2\n" + keys +
         "\n";
}

}  // namespace

TEST_CASE("sources and drains read, and write what they read") {
  for (const std::string list : {"source", "drain"}) {
    const Scene s = parse(opening(list, "rate = \"0.1*t\"\nfrom = 0.2\nuntil = 0.9\nattached_to = \"arm\"") + arm);
    const LiquidSourceSpec& found = list == "source" ? s.liquid.sources.at(0) : s.liquid.drains.at(0);
    CHECK(found.rate == "0.1*t");
    CHECK(found.attached_to == "arm");
    CHECK(found.from == 0.2);
    CHECK(found.until == 0.9);
    CHECK(write_scene(parse(write_scene(s))) == write_scene(s));
    const Scene moving = parse(opening(list,
                                       "motion = { translate = [\"0.1*t\", 0, 0], rotate = { axis = [0, 1, 0], "
                                       "center = [0.5, 0.5, 0.5], degrees = \"90*t\" } }"));
    const auto& motion = (list == "source" ? moving.liquid.sources : moving.liquid.drains).at(0).motion;
    REQUIRE(motion);
    CHECK(motion->degrees == "90*t");
    CHECK(write_scene(parse(write_scene(moving))) == write_scene(moving));
  }
}

TEST_CASE("rates are finite and not negative") {
  check_refused(opening("source", "rate = -0.1"), "liquid.source.0.rate must be >= 0 m^3/s; it is -0.1");
  check_refused(opening("source", "rate = \"0.1-t\""), "liquid.source.0.rate = \"0.1-t\" is -0.");
  check_refused(opening("drain", "rate = \"t-0.1\""), "the opposite is a [[liquid.source]]");
  check_refused(opening("drain", "rate = \"1/(t-0.5)^2\"\nfrom = 0.5"), "it must be finite and at least 0");
  check_refused(opening("drain", "rate = \"x\""), "liquid.drain.0.rate");
  check_refused(opening("source", "rate = 0.1\nvelocity = [1, 0, 0]"), "leave velocity or rate out");
  check_refused(opening("drain", "velocity = [1, 0, 0]"), "unknown key 'velocity' in [[liquid.drain]]");
  check_refused(opening("drain", "from = 0.5\nuntil = 0.5"), "[[liquid.drain]] must begin before its until");
}

TEST_CASE("sources are attached to solids that are there and do not deform") {
  check_refused(opening("source", "attached_to = \"amr\"") + arm, "no solid is named \"amr\"; did you mean \"arm\"?");
  check_refused(opening("drain", "attached_to = \"x\""), "liquid.drain.0.attached_to: no solid is named \"x\"");
  check_refused(opening("source", "attached_to = \"gate\"") + arm + gate,
                "\"gate\" is a solid that deforms; there is \"arm\"");
  check_refused(opening("source", "attached_to = \"arm\"\nmotion = { translate = [\"t\", 0, 0] }") + arm, "not both");
  check_refused(opening("source", "motion = { translate = [\"t < 0.5 ? 0 : 100\", 0, 0] }"),
                "liquid.source.0: the motion jumps");
  check_refused(opening("source", "motion = { translate = [\"1/t\", 0, 0] }"), "is not finite");
}

TEST_CASE("height maps rise against gravity, if they have no axis of their own") {
  const ScratchFolder folder;
  folder.write("m.csv", "1 2\n3 4\n");
  const auto map = [&](const std::string& gravity, const std::string& more) {
    return "gravity = " + gravity + "\n" + small_scene +
           "[[liquid.region]]\nshape = \"height_map\"\nfile = \"m.csv\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n" + more;
  };
  const auto up = [&](const std::string& text) { return parse(text, {}, folder.path()).liquid.regions.at(0).shape.up; };
  CHECK(up(map("[0, -9.81, 0]", "")) == "y");
  CHECK(up(map("[0, 1, 2]", "")) == "-z");
  CHECK(up(map("[0, 0, 0]", "")) == "y");
  CHECK(up(map("[0, -9.81, 0]", "up = \"x\"\n")) == "x");
  const auto refused = [&](const std::string& text, const std::string& expected) {
    INFO(text);
    CHECK_THAT(fault(text, {}, folder.path()), Catch::Matchers::Contains(expected));
  };
  refused(map("[0, -1, 0]", "up = \"w\"\n"), "liquid.region.0.up must be \"x\"");
  const std::string flat =
      "dimension = 2\ngravity = [0, -1]\n" + flat_scene.substr(flat_scene.find('[')) +
      "[[liquid.region]]\nshape = \"height_map\"\nfile = \"m.csv\"\nlower = [0, 0]\nupper = [1, 1]\n";
  refused(flat + "up = \"z\"\n", "a scene in 2D has no axis z");
  folder.write("m.jpg", "x");
  refused(small_scene +
              "[[liquid.region]]\nshape = \"height_map\"\nfile = \"m.jpg\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n",
          "a height_map is read from .png, .csv, .txt or .asc, not 'm.jpg'");
  refused(small_scene +
              "[[liquid.region]]\nshape = \"height_map\"\nfile = \"../m.csv\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n",
          "allow_outside_files");
  refused(small_scene +
              "[[liquid.region]]\nshape = \"height_map\"\nfile = \"none.png\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n",
          "none.png");
  refused(small_scene +
              "[[solid]]\nkind = \"rigid\"\ndensity = 1\nshape = \"height_map\"\nfile = \"m.csv\"\nlower = [0, 0, "
              "0]\nupper = [1, 1, 1]\n",
          "a rigid solid must be bounded: a height_map is not");
}

}  // namespace sources_tests
