// Tables and estimates of `seiche check`.
#include "run/start_table.h"

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "run/estimate.h"
#include "run/expected_speed.h"
#include "scene/reader.h"

namespace start_table_tests {
using namespace seiche;

namespace {

Scene tank(const std::string& solids, const std::string& more = "") {
  return parse_scene(more +
                         "dimension = 3\n[domain]\nupper = [1.0, 1.0, 1.0]\ncell_size = 0.0625\n[time]\nend = 1.0\n"
                         "frame_rate = 10.0\n[[liquid.region]]\nshape = \"box\"\nlower = [0.0, 0.0, 0.0]\n"
                         "upper = [1.0, 0.25, 1.0]\n" +
                         solids,
                     "scene.toml", ".");
}

std::string body(const std::string& name, const std::string& shape, double density) {
  return "[[solid]]\nname = \"" + name + "\"\nkind = \"rigid\"\ndensity = " + std::to_string(density) + "\n" + shape;
}

const std::string ball = "shape = \"sphere\"\ncenter = [0.3, 0.6, 0.3]\nradius = 0.15\n";
const std::string box = "shape = \"box\"\nlower = [0.6, 0.5, 0.6]\nupper = [0.9, 0.7, 0.8]\n";

}  // namespace

TEST_CASE("a body of half the liquid's density floats to its middle, also under gravity along another axis") {
  const Communicator ranks;
  for (const bool turned : {false, true}) {
    Scene scene = tank(body("ball", ball, 500) + body("box", box, 500), turned ? "gravity = [9.81, 0.0, 0.0]\n" : "");
    const StartAccount start = make_simulation(scene, ranks)->start_account();
    REQUIRE(start.solids.size() == 2);
    REQUIRE((start.solids[0].floating && start.solids[1].floating));
    // The ball is a contour at cells of a seventh of its diameter: its middle is known to a thousandth of it.
    CHECK(start.solids[0].floating->draught == Approx(0.15).epsilon(1e-2));
    CHECK(start.solids[1].floating->draught == Approx(turned ? 0.15 : 0.1).epsilon(1e-6));  // bisection to 1e-9
    CHECK(start.solids[1].mass == Approx(500 * 0.3 * 0.2 * 0.2));
    CHECK(start.solids[1].density() == Approx(500));
  }
}

TEST_CASE("heavy bodies sink, and bodies without gravity neither float nor sink") {
  const Communicator ranks;
  const StartAccount heavy = make_simulation(tank(body("stone", box, 2000)), ranks)->start_account();
  CHECK(heavy.solids.at(0).floating->sinks);
  const StartAccount weightless =
      make_simulation(tank(body("stone", box, 2000), "gravity = [0.0, 0.0, 0.0]\n"), ranks)->start_account();
  CHECK_FALSE(weightless.solids.at(0).floating);
}

TEST_CASE("the table has a row a solid, with the columns below each other") {
  StartAccount start;
  start.liquid = {0.5, 500, 0.1};
  SolidAtStart one;
  one.name = "a";
  one.kind = "rigid";
  one.volume = 0.02;
  one.mass = 10;
  one.center = {0.5, 0.25, 0};
  one.lower = {0.4, 0.2, 0};
  one.upper = {0.6, 0.3, 0};
  one.floating = Floating{false, 0.05};
  SolidAtStart hole;
  hole.name = "tank";
  hole.kind = "static";
  hole.extent = SolidAtStart::Extent::hole;
  start.solids = {one, hole};
  const std::vector<std::string> lines = start_table(start, 2);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == "liquid  0.5 m^2, 500 kg/m; 0.1 m^2 of its regions lies inside solids");
  CHECK(lines[2].starts_with("'a'     rigid"));
  CHECK(lines[2].ends_with("10     500  0.02  (0.5, 0.25)  0.2 x 0.1           floats, 0.05 m"));
  CHECK(lines[3].ends_with("all but a hole"));
  CHECK(lines[2].find("floats") == lines[1].find("draught"));
  start.solids.assign(100, one);
  CHECK(start_table(start, 2).back() == "and 60 more solids");
}

TEST_CASE("estimates grow with the grid and take trial steps") {
  const Communicator ranks;
  const Scene scene = tank("");
  const RunSize size = measure_size(scene, *make_simulation(scene, ranks), ranks);
  CHECK(size.cells == 4096);
  CHECK(size.fluid == 1024);
  CHECK(size.near == 16 * 16 * 7);  // and the cells whose centres are within three cells of the surface
  CHECK(size.fall == Approx(0).margin(1e-12));
  RunSize finer = size;
  finer.near *= 8;
  finer.cells *= 8;
  const RunEstimate one = estimate_run(scene, size, 1, 1, {}), eight = estimate_run(scene, finer, 1, 1, {});
  CHECK(one.frames == 11);
  CHECK(one.memory < eight.memory);
  CHECK(one.disk() < eight.disk());
  const RunEstimate tried = estimate_run(scene, size, 1, 1, TrialSteps{5, 2, 1, 3, 0.001, 1e12});
  CHECK(tried.memory == 1e12);
  CHECK(tried.steps >= 1000);
  CHECK(tried.seconds == 2 * tried.steps);
}

TEST_CASE("liquid that a container holds does not fall, and loose liquid does") {
  const Communicator ranks;
  const auto fall = [&](const std::string& solids) {
    Scene scene = tank(solids);
    scene.liquid.regions[0].shape.lower = {0.375, 0.5, 0.375};
    scene.liquid.regions[0].shape.upper = {0.625, 0.625, 0.625};
    return measure_size(scene, *make_simulation(scene, ranks), ranks).fall;
  };
  // A box of 4 x 2 x 4 cells, 8 to 10 cells above the floor: one layer of the domain takes it.
  CHECK(fall("") == Approx(8.5 / 16));
  CHECK(fall("[[solid]]\nkind = \"static\"\nshape = \"expression\"\n"
             "phi = \"abs(max(max(abs(x-0.5), abs(z-0.5))-0.1875, abs(y-0.5625)-0.125))-0.0625\"\n") ==
        Approx(0).margin(1e-12));
  // The same container lifts off: it bounds nothing.
  CHECK(fall("[[solid]]\nname = \"bell\"\nkind = \"kinematic\"\nshape = \"expression\"\n"
             "phi = \"abs(max(max(abs(x-0.5), abs(z-0.5))-0.1875, abs(y-0.5625)-0.125))-0.0625\"\n"
             "motion.translate = [\"0\", \"0.1*t\", \"0\"]\n") == Approx(8.5 / 16));
}

TEST_CASE("estimates know the speeds of kinematic solids and of liquid that enters") {
  Scene scene = tank("");
  CHECK(speed_of_kinematic_solids(scene, {}) == 0);
  CHECK(speed_of_feeds(scene) == 0);
  SolidSpec wheel;
  wheel.kind = SolidKind::kinematic;
  wheel.motion.translate = {"0.5*t", "0", "0"};
  wheel.motion.degrees = "180*t";
  scene.solids = {wheel};
  const SurfaceMesh surface{{{0.2, 0, 0}, {0, 0.1, 0.4}}, {}, {}};
  CHECK(speed_of_kinematic_solids(scene, {surface}) == Approx(0.5 + 0.2 * M_PI).epsilon(1e-6));
  SideSpec& lid = scene.domain.sides[1][1];
  lid.type = SideType::inflow;
  lid.velocity = {"0", "-t", "0"};
  const double fall = scene.domain.upper[1] - scene.domain.lower[1], end = scene.time.end;
  CHECK(speed_of_feeds(scene) == Approx(std::sqrt(end * end + 2 * 9.81 * fall)));
}

}  // namespace start_table_tests
