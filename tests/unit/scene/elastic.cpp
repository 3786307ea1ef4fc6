// Elastic solids in scene files.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "run/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace elastic_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string rubber = "material = { youngs_modulus = 1e6, poisson_ratio = 0.4 }\n";
const std::string bottom = "pinned = { shape = \"plane\", point = [0, 0.3, 0], normal = [0, 1, 0] }\n";

// A ball in 3D, a disc in 2D, without additional keys.
std::string bare(int dimension, const std::string& keys) {
  const std::string center = dimension == 2 ? "[0.5, 0.5]" : "[0.5, 0.5, 0.5]";
  return (dimension == 2 ? flat_scene : small_scene) +
         "[[solid]]\nkind = \"elastic\"\nshape = \"sphere\"\nradius = 0.2\ncenter = " + center + "\n" + keys;
}

// With all required keys.
std::string ball(const std::string& keys) {
  return bare(3, "density = 1100\nelement_size = 0.05\n" + rubber + keys);
}

std::string made_of(const std::string& material) {
  return bare(3, "density = 1100\nelement_size = 0.05\nmaterial = { " + material + " }\n");
}

}  // namespace

TEST_CASE("an elastic solid has a material, elements, pins and forces") {
  const SolidSpec solid =
      parse(bare(3,
                 "density = 1100\nvelocity = [1, 0, 0]\nfriction = 0.2\nelement_size = 0.05\nelement_order = 1\n"
                 "material = { model = \"neo_hookean\", youngs_modulus = 1e6, poisson_ratio = 0.45, damping = 1e-3, "
                 "mass_damping = 0.5 }\nbody_force = [0, \"10*t\", \"x\"]\n" +
                     bottom))
          .solids[0];
  CHECK(solid.kind == SolidKind::elastic);
  CHECK(solid.rigid.density == 1100);
  CHECK(solid.rigid.velocity == Vec3(1, 0, 0));
  const ElasticSpec& e = solid.elastic;
  CHECK(e.model == "neo_hookean");
  CHECK(e.youngs_modulus == 1e6);
  CHECK(e.poisson_ratio == 0.45);
  CHECK(e.damping == 1e-3);
  CHECK(e.mass_damping == 0.5);
  CHECK(e.element_size == 0.05);
  CHECK(e.element_order == 1);
  CHECK(e.body_force == VectorFormula{"0.0", "10*t", "x"});
  REQUIRE(e.pinned.size() == 1);
  CHECK(e.pinned[0].shape.kind == "plane");
  CHECK(e.pinned[0].shape.where == "scene.toml:18");
}

TEST_CASE("what an elastic solid leaves out has a default") {
  const ElasticSpec e = parse(ball("")).solids[0].elastic;
  CHECK(e.model == "stable_neo_hookean");
  CHECK(e.damping == 0);
  CHECK(e.element_order == 2);
  CHECK(e.pinned.empty());
}

TEST_CASE("pins are one table or several") {
  const std::string pin =
      "{ shape = \"sphere\", center = [0.5, 0.3, 0.5], radius = 0.1, motion = { translate = "
      "[\"0.1*t\", 0, 0], rotate = { axis = [0, 1, 0], degrees = \"90*t\" } } }";
  const std::string other = "{ shape = \"box\", lower = [0, 0, 0], upper = [1, 0.35, 1] }";
  const ElasticSpec one = parse(ball("pinned = " + pin)).solids[0].elastic;
  REQUIRE(one.pinned.size() == 1);
  CHECK(one.pinned[0].motion.translate[0] == "0.1*t");
  CHECK(one.pinned[0].motion.degrees == "90*t");
  const ElasticSpec two = parse(ball("pinned = [" + pin + ", " + other + "]")).solids[0].elastic;
  REQUIRE(two.pinned.size() == 2);
  CHECK(two.pinned[1].shape.upper == Vec3(1, 0.35, 1));
  CHECK(parse(ball("[[solid.pinned]]\nshape = \"sphere\"\ncenter = [0.5, 0.3, 0.5]\nradius = 0.1\n"))
            .solids[0]
            .elastic.pinned.size() == 1);
  CHECK(parse(ball("pinned = []")).solids[0].elastic.pinned.empty());
}

TEST_CASE("a material is within what elasticity allows") {
  for (const char* value : {"0", "-1", "nan", "inf"}) {
    check_refused(made_of(fmt::format("youngs_modulus = {}, poisson_ratio = 0.3", value)),
                  "material.youngs_modulus must be > 0 Pa");
  }
  for (const char* value : {"0.5", "0.51", "1", "inf"}) {
    check_refused(made_of(fmt::format("youngs_modulus = 1e6, poisson_ratio = {}", value)),
                  "material.poisson_ratio must be below 0.5");
  }
  check_refused(made_of("youngs_modulus = 1e6, poisson_ratio = 0.5"), "bulk modulus");
  check_refused(made_of("youngs_modulus = 1e6, poisson_ratio = -0.1"), "poisson_ratio must be >= 0 and < 0.5");
  check_refused(made_of("poisson_ratio = 0.3"), "needs 'youngs_modulus'");
  check_refused(made_of("youngs_modulus = 1e6"), "needs 'poisson_ratio'");
  check_refused(made_of("youngs_modulus = 1e6, poisson_ratio = 0.3, damping = -1"), "material.damping must be >= 0 s");
  check_refused(made_of("youngs_modulus = 1e6, poisson_ratio = 0.3, model = \"corotatde\""),
                "did you mean \"corotated\"?");
  check_refused(made_of("youngs_modulus = 1e6, poisson_ratio = 0.3, model = \"x\""),
                "\"stable_neo_hookean\", \"neo_hookean\", \"corotated\" or \"st_venant_kirchhoff\"");
  check_refused(made_of("yongs_modulus = 1e6, poisson_ratio = 0.3"), "did you mean 'youngs_modulus'?");
  for (const char* value : {"1e2", "1e12"})
    CHECK_NOTHROW(parse(made_of(fmt::format("youngs_modulus = {}, poisson_ratio = 0.499", value))));
}

TEST_CASE("an elastic solid is bounded and has elements") {
  check_refused(ball("invert = true\n"), "an elastic solid must be bounded: an inverted shape is not");
  check_refused(small_scene +
                    "[[solid]]\nkind = \"elastic\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n"
                    "density = 1\nelement_size = 0.1\n" +
                    rubber,
                "an elastic solid must be bounded: a plane is not");
  check_refused(bare(3, "density = 1\n" + rubber), "needs 'element_size' (m)");
  check_refused(bare(3, "density = 1\nelement_size = 0\n" + rubber), "element_size must be > 0 m");
  check_refused(ball("element_order = 3\n"), "element_order must be >= 1 and <= 2; it is 3");
  check_refused(bare(3, "element_size = 0.05\n" + rubber), "needs 'density' with kind = \"elastic\"");
  check_refused(bare(3, "element_size = 0.05\ndensity = 1\n"), "needs 'material' with kind = \"elastic\"");
  check_refused(ball("fixed = [\"x\"]\n"), "'fixed' in [[solid]] is only for kind = \"rigid\"");
  check_refused(ball("body_force = [0, \"1/0\", 0]\n"), "body_force");
}

TEST_CASE("tractions must be shapes with a stress") {
  const std::string face = "shape = \"box\", lower = [0, 0, 0], upper = [1, 1, 1]";
  const ElasticSpec e = parse(ball("traction = { " + face + ", stress = [\"1e3*t\", 0, \"y\"] }\n")).solids[0].elastic;
  REQUIRE(e.tractions.size() == 1);
  CHECK(e.tractions[0].shape.kind == "box");
  CHECK(e.tractions[0].stress == VectorFormula{"1e3*t", "0.0", "y"});
  check_refused(ball("traction = 3\n"), "solid.0.traction must be a table");
  check_refused(ball("traction = { " + face + " }\n"), "needs 'stress'");
  check_refused(ball("traction = { stress = [1, 0, 0] }\n"), "needs 'shape'");
  check_refused(ball("traction = { " + face + ", stress = [\"x+q\", 0, 0] }\n"), "solid.0.traction.stress");
  check_refused(ball("traction = { " + face + ", pressure = 3 }\n"), "'pressure'");
  check_refused(small_scene + "[[solid]]\nshape = \"sphere\"\nradius = 0.2\ncenter = [0.5, 0.5, 0.5]\ntraction = { " +
                    face + ", stress = [1, 0, 0] }\n",
                "'traction' in [[solid]] is only for kind = \"elastic\"");
}

TEST_CASE("pins must be shapes and their motions continuous") {
  check_refused(ball("pinned = 3\n"), "solid.0.pinned must be a table");
  check_refused(ball("pinned = [3]\n"), "solid.0.pinned.0 must be a table");
  check_refused(ball("pinned = { shape = \"box\" }\n"), "needs 'lower' with shape = \"box\"");
  check_refused(ball("pinned = { shape = \"box\", lower = [0, 0, 0], upper = [0, 1, 1] }\n"),
                "must have lower < upper");
  check_refused(ball("pinned = { shape = \"sphere\", center = [0, 0, 0], radius = 1, motion = { translate = "
                     "[\"sqrt(0.5-t)-sqrt(0.5)\","
                     " 0, 0] } }\n"),
                "solid \"solid1\", pinned: the motion is not finite at t = 0.5005 s");
  check_refused(
      ball("pinned = { shape = \"sphere\", center = [0, 0, 0], radius = 1, motion = { translate = [0.1, 0, 0] "
           "} }\n"),
      "pinned: the motion must begin at the rest pose; at t = 0 it moves by 0.1 m");
  check_refused(
      ball("pinned = { shape = \"sphere\", center = [0, 0, 0], radius = 1, motion = { trnslate = [0, 0, 0] } }"),
      "did you mean 'translate'?");
  check_refused(small_scene + "[domain.boundary]\nx_lower = \"periodic\"\nx_upper = \"periodic\"\n" +
                    ball("").substr(small_scene.size()),
                "elastic solid \"solid1\" may move along x, but solids cannot cross the periodic sides along x");
}

// A pin is 1e-5 domain widths away from its start in domains of a micrometre and of a kilometre, and 1e-12 of them.
TEST_CASE("pins begin at rest positions to a share of the domain") {
  for (const double width : {1e-6, 1e3}) {
    const auto moved = [width](double share) {
      return fmt::format(
          "dimension = 2\n[domain]\nupper = [{0}, {0}]\ncell_size = {1}\n[time]\nend = 1\n[[solid]]\n"
          "kind = \"elastic\"\nshape = \"sphere\"\nradius = {1}\ncenter = [{2}, {2}]\ndensity = 1\n"
          "element_size = {1}\n{3}pinned = {{ shape = \"sphere\", center = [{2}, {2}], radius = {1}, "
          "motion = {{ translate = [{4}, 0] }} }}\n",
          width, width / 16, width / 2, rubber, share * width);
    };
    check_refused(moved(1e-5), "the motion must begin at the rest pose");
    CHECK_NOTHROW(parse(moved(1e-12)));
  }
}

TEST_CASE("an elastic solid may be read from a file of elements, another not") {
  const ScratchFolder folder;
  for (const char* name : {"body.msh", "body.vtu", "body.MESH", "body.obj"}) folder.write(name, "x");
  const auto from = [](const std::string& start, const std::string& file, const std::string& keys) {
    return start + "[[solid]]\nshape = \"mesh\"\nfile = \"" + file + "\"\n" + keys;
  };
  const std::string keys = "kind = \"elastic\"\ndensity = 1\n" + rubber;
  for (const std::string& start : {small_scene, flat_scene}) {
    for (const char* name : {"body.msh", "body.vtu", "body.MESH"}) {
      const SolidSpec solid = parse(from(start, name, keys), {}, folder.path()).solids[0];
      CHECK(solid.elastic.element_size == 0);
      CHECK_THAT(fault(from(start, name, keys + "element_size = 0.1\n"), {}, folder.path()),
                 Contains("element_size has no effect, because the elements come from '"));
    }
  }
  for (const std::string& start : {small_scene, flat_scene})
    CHECK_NOTHROW(parse(from(start, "body.obj", keys + "element_size = 0.1\n"), {}, folder.path()));
  CHECK_THAT(fault(from(small_scene, "body.obj", keys), {}, folder.path()), Contains("needs 'element_size'"));
  folder.write("body.stl", "x");
  CHECK_THAT(fault(from(flat_scene, "body.stl", keys + "element_size = 0.1\n"), {}, folder.path()),
             Contains("a mesh in 2D is a closed outline") && Contains("or elements in .msh, .vtu or .mesh"));
  CHECK_THAT(fault(from(small_scene, "body.msh", "kind = \"rigid\"\ndensity = 1\n"), {}, folder.path()),
             Contains("elements are for elastic solids"));
}

// Independent of the writer: compares the data.
TEST_CASE("elastic solids survive being written") {
  const std::string pin =
      "{ shape = \"sphere\", center = [0.5, 0.3, 0.5], radius = 0.1, motion = { translate = "
      "[\"0.1*t\", 0, 0], rotate = { axis = [0, 1, 0], degrees = \"90*t\" } } }";
  for (const std::string& pins : {std::string(), "pinned = " + pin, "pinned = [" + pin + ", " + pin + "]"}) {
    const Scene scene =
        parse(ball(pins + "\nbody_force = [0, \"10*t\", \"x\"]\ntraction = [{ shape = \"sphere\", center = "
                          "[0.5, 0.7, 0.5], radius = 0.1, stress = [\"t\", 0, 1] }]"));
    const std::string written = write_scene(scene);
    INFO(written);
    const Scene again = parse(written);
    const ElasticSpec &a = scene.solids[0].elastic, &b = again.solids[0].elastic;
    CHECK(a.model == b.model);
    CHECK(a.youngs_modulus == b.youngs_modulus);
    CHECK(a.poisson_ratio == b.poisson_ratio);
    CHECK(a.element_size == b.element_size);
    CHECK(a.body_force == b.body_force);
    REQUIRE(b.tractions.size() == 1);
    CHECK(a.tractions[0].stress == b.tractions[0].stress);
    CHECK(a.tractions[0].shape.center == b.tractions[0].shape.center);
    REQUIRE(a.pinned.size() == b.pinned.size());
    for (std::size_t i = 0; i < a.pinned.size(); ++i) {
      CHECK(a.pinned[i].shape.center == b.pinned[i].shape.center);
      CHECK(a.pinned[i].motion.translate == b.pinned[i].motion.translate);
      CHECK(a.pinned[i].motion.degrees == b.pinned[i].motion.degrees);
      CHECK(a.pinned[i].motion.axis == b.pinned[i].motion.axis);
    }
    CHECK(write_scene(again) == written);
    CHECK(scene_hash(scene) == scene_hash(again));
  }
}

TEST_CASE("a run does not go on with another elastic solid than it began with") {
  const std::string text = ball(bottom);
  const Scene before = parse(text);
  for (const auto& [key, value, named] :
       std::vector<std::array<std::string, 3>>{{"solid.0.material.youngs_modulus", "2e6", "solid.0.material"},
                                               {"solid.0.element_size", "0.06", "solid.0.element_size"},
                                               {"solid.0.pinned.point", "[0, 0.4, 0]", "solid.0.pinned"}}) {
    const std::vector<std::string> changed = changed_keys(before, parse(text, {{key, value}}));
    CHECK(changed == std::vector<std::string>{named});
    CHECK(forbidden_changes(changed, EditPolicy::force) == changed);
  }
}

TEST_CASE("a displacement probe follows a point of an elastic solid") {
  const std::string probe = "\n[[probe]]\nkind = \"displacement\"\nposition = [0.5, 0.6, 0.5]\n";
  const Scene scene = parse(ball("name = \"gate\"" + probe + "solid = \"gate\"\n"));
  CHECK(scene.probes[0].kind == ProbeKind::displacement);
  CHECK(scene.probes[0].solid == "gate");
  CHECK(scene.probes[0].where == "scene.toml:15");
  CHECK(parse(write_scene(scene)).probes[0].solid == "gate");
  check_refused(ball(probe), "needs 'solid' with kind = \"displacement\"");
  check_refused(ball("name = \"gate\"" + probe + "solid = \"gat\"\n"),
                "probe \"probe1\" needs an elastic solid, and \"gat\" is none; did you mean \"gate\"?");
  check_refused(ball(probe + "solid = \"x\"\n"), "there is \"solid1\"");
  check_refused(small_scene + probe + "solid = \"x\"\n", "the scene has none");
  check_refused(small_scene + "[[probe]]\nkind = \"pressure\"\nposition = [0, 0, 0]\nsolid = \"x\"\n",
                "'solid' in [[probe]] is only for kind = \"displacement\"");
}

}  // namespace elastic_tests
