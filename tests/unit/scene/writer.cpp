#include <catch2/catch.hpp>

#include "base/gravity.h"
#include "base/scene.h"
#include "unit/scene/common.h"

namespace writer_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> shapes{"box",  "sphere",     "cylinder",  "capsule",   "plane",
                                      "mesh", "expression", "level_set", "height_map"};
const std::vector<std::string> sides{"free_slip", "no_slip", "periodic", "inflow", "outflow", "moving_wall", "waves"};
const std::vector<std::string> probes{"pressure", "velocity", "surface_height", "front", "displacement", "flux",
                                      "volume",   "force",    "torque",         "line",  "plane"};

}  // namespace

TEST_CASE("a written scene reads back to the same scene") {
  const ScratchFolder folder;
  folder.write("s.obj", "o\n");
  folder.write("s.vdb", "v");
  folder.write("s.png", "p");
  for (const int dimension : {2, 3}) {
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const std::string& shape = shapes[i % shapes.size()];
      if (dimension == 2 && shape == "mesh") continue;
      const std::string text = rich_scene(dimension, shape, sides[i % sides.size()], probes[i % probes.size()]);
      const Scene scene = parse(text, {}, folder.path());
      const std::string written = write_scene(scene);
      const Scene again = parse(written, {}, "/");
      INFO(written);
      CHECK(write_scene(again) == written);
      CHECK(changed_keys(scene, again).empty());
    }
  }
}

// Independent of the writer: compares the data themselves, to the bit.
TEST_CASE("writing and reading keeps every number to the bit") {
  Scene scene = parse(rich_scene(3, "sphere", "moving_wall", "velocity"));
  scene.gravity = Vec3(1.0 / 3, -9.80665, 1e-300);
  scene.liquid.density = 997.0479000000001;
  scene.solids[0].shape.center = Vec3(0.1 + 0.2, 1e-17, -123456789.125);
  scene.solver.tolerance = 4.9e-324;
  const Scene again = parse(write_scene(scene));
  CHECK(Gravity(again.gravity).at(0) == Vec3(1.0 / 3, -9.80665, 1e-300));
  CHECK(again.liquid.density == scene.liquid.density);
  CHECK(again.solids[0].shape.center == scene.solids[0].shape.center);
  CHECK(again.solver.tolerance == scene.solver.tolerance);
  CHECK(again.domain.sides[0][0].velocity == scene.domain.sides[0][0].velocity);
  CHECK(again.solids[1].motion.translate == scene.solids[1].motion.translate);
}

TEST_CASE("every default is written out") {
  const std::string text = write_scene(parse(small_scene));
  for (const char* part : {"title = \"\"",
                           "dimension = 3",
                           "gravity = [0.0, -9.81, 0.0]",
                           "x_lower = \"free_slip\"",
                           "z_upper = \"free_slip\"",
                           "frame_rate = 24.0",
                           "cfl = 1.0",
                           "scheme = \"second_order\"",
                           "density = 1000.0",
                           "viscosity = 0.0",
                           "separates = false",
                           "surface_tension = 0.0",
                           "surface_tension_scheme = \"explicit\"",
                           "contact_angle = 90.0",
                           "method = \"level_set\"",
                           "tolerance = 1e-08",
                           "preconditioner = \"auto\"",
                           "viscosity = \"auto\"",
                           "rheology_tolerance = 0.0001",
                           "rheology_iterations = 30",
                           "frames = [\"surface\", \"velocity\"]",
                           "formats = [\"vdb\"]",
                           "checkpoint_every = 10"}) {
    CHECK_THAT(text, Contains(part));
  }
}

TEST_CASE("texts with quotes, backslashes and letters of all kinds survive") {
  Scene scene = parse(small_scene);
  scene.title = "a \"b\" \\c\\ é 水";
  CHECK(parse(write_scene(scene)).title == scene.title);
}

TEST_CASE("changed keys are named by their path") {
  const std::string text = rich_scene(3, "sphere", "inflow", "pressure");
  const Scene a = parse(text);
  const Scene b = parse(text, {{"liquid.density", "900"}, {"solid.0.radius", "0.2"}, {"time.max_step", "0.02"}});
  CHECK(changed_keys(a, a).empty());
  CHECK(changed_keys(a, b) == std::vector<std::string>{"time.max_step", "liquid.density", "solid.0.radius"});
  const Scene more = parse(text + "[[solid]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n");
  CHECK(changed_keys(a, more) == std::vector<std::string>{"solid.5"});
  CHECK(changed_keys(more, a) == std::vector<std::string>{"solid.5"});
}

}  // namespace writer_tests
