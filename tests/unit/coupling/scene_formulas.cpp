// Formulas without a finite value, at the start and later.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "unit/coupling/end.h"
#include "verification/scenes.h"

namespace scene_formulas_tests {
using namespace seiche;

namespace {

// A pool, above it a sphere of liquid with its own velocity, and a source in the air.
Scene pool() {
  Scene s = test::box_scene(2, 16);
  s.gravity = {0, -9.81, 0};
  test::add_liquid(s, "y-0.4");
  LiquidRegionSpec drop;
  drop.shape.kind = "sphere";
  drop.shape.center = {0.3, 0.7, 0};
  drop.shape.radius = 0.15;
  drop.velocity = VectorFormula{"0", "0", "0"};
  s.liquid.regions.push_back(drop);
  LiquidSourceSpec tap;
  tap.shape.kind = "box";
  tap.shape.lower = {0.6, 0.7, 0};
  tap.shape.upper = {0.8, 0.9, 0};
  tap.from = 0.02;
  s.liquid.sources.push_back(tap);
  return s;
}

SideSpec& side(Scene& s, int axis, int end, SideType type) {
  SideSpec& spec = s.domain.sides[axis][end];
  spec.type = type;
  return spec;
}

struct Row {
  std::string said;
  std::function<void(Scene&, const Formula&)> put;
};

// Every key that takes a formula of x, y and t.
const std::vector<Row> table{
    {"liquid.velocity[1] = ", [](Scene& s, const Formula& f) { s.liquid.velocity[1] = f; }},
    {"liquid.region.1.velocity[0] = ", [](Scene& s, const Formula& f) { (*s.liquid.regions[1].velocity)[0] = f; }},
    {"liquid.viscosity = ", [](Scene& s, const Formula& f) { s.liquid.viscosity = f; }},
    {"domain.boundary.x_lower.velocity[0] = ",
     [](Scene& s, const Formula& f) {
       side(s, 0, 0, SideType::inflow).velocity[0] = f;
       side(s, 1, 1, SideType::outflow);
     }},
    {"domain.boundary.y_lower.velocity[0] = ",
     [](Scene& s, const Formula& f) { side(s, 1, 0, SideType::moving_wall).velocity[0] = f; }},
    {"domain.boundary.x_upper.pressure = ",
     [](Scene& s, const Formula& f) { side(s, 0, 1, SideType::outflow).pressure = f; }},
    {"liquid.source.0.velocity[0] = ", [](Scene& s, const Formula& f) { s.liquid.sources[0].velocity[0] = f; }},
};

}  // namespace

TEST_CASE("a formula that is not finite at the start is a mistake of the scene, said by key and place") {
  for (const auto& [formula, value] : {std::pair("sqrt(-1-x)", "nan"), std::pair("1/(0*x)", "infinite")})
    for (const Row& row : table) {
      Scene s = pool();
      row.put(s, formula);
      const auto [text, code] = test::end_of(s, 0.1);
      INFO(row.said << formula << ": " << text);
      CHECK(code == ExitCode::bad_input);
      CHECK(text.find(row.said + '"' + formula + "\" is " + value + " at (") != std::string::npos);
    }
}

TEST_CASE("gravity that is not finite is a mistake of the scene at the start and ends the run later") {
  for (const auto& [formula, value] : {std::pair("sqrt(-1-t)", "nan"), std::pair("1/t", "infinite")}) {
    Scene s = pool();
    s.gravity.formula[1] = formula;
    const auto [text, code] = test::end_of(s, 0.1);
    INFO(text);
    CHECK(code == ExitCode::bad_input);
    CHECK(text ==
          "gravity[1] = \"" + Formula(formula) + "\" is " + value + " at t = 0 s; it must be a finite number there");
  }
  Scene s = pool();
  s.gravity.formula[0] = "0*sqrt(0.04-t)";
  const auto [text, code] = test::end_of(s, 0.1);
  INFO(text);
  CHECK(code == ExitCode::cannot_continue);
  CHECK(text.find("gravity[0] = \"0*sqrt(0.04-t)\" is nan at t = 0.0") != std::string::npos);
}

TEST_CASE("a shape's formula that is not finite is said with its place in the scene") {
  for (const Formula formula : {"sqrt(x-0.5)-0.1", "1/(0*x)"}) {
    Scene s = pool();
    s.liquid.regions[0].shape.phi = formula;
    s.liquid.regions[0].shape.where = "scene.toml:7";
    const auto [text, code] = test::end_of(s, 0.1);
    INFO(text);
    CHECK(code == ExitCode::bad_input);
    CHECK(text.find("scene.toml:7: phi = \"" + formula) == 0);
  }
}

TEST_CASE("a formula that stops being finite ends the run in that step, by name") {
  for (const Row& row : table) {
    if (row.said.find("liquid.velocity") == 0 || row.said.find("liquid.region") == 0) continue;  // used at t = 0 only
    Scene s = pool();
    row.put(s, "0*sqrt(0.04-t)");
    const auto [text, code] = test::end_of(s, 0.1);
    INFO(row.said << ": " << text);
    CHECK(code == ExitCode::cannot_continue);
    CHECK(text.find(row.said + "\"0*sqrt(0.04-t)\" is nan at (") != std::string::npos);
  }
}

TEST_CASE("a motion that stops being finite ends the run in that step, by name") {
  Scene s = pool();
  SolidSpec paddle;
  paddle.name = "paddle";
  paddle.kind = SolidKind::kinematic;
  paddle.shape.kind = "sphere";
  paddle.shape.center = {0.7, 0.2, 0};
  paddle.shape.radius = 0.1;
  paddle.motion.translate[0] = "0.1*sqrt(0.04-t)";
  s.solids.push_back(paddle);
  const auto [text, code] = test::end_of(s, 0.1);
  INFO(text);
  CHECK(code == ExitCode::cannot_continue);
  CHECK(text.find("solid 'paddle': its motion is not finite at t = ") != std::string::npos);
}

TEST_CASE("viscosity that is negative somewhere is a mistake at the start and ends the run later") {
  for (const auto& [formula, when, code] : {std::tuple("x-0.5", "t = 0 s", ExitCode::bad_input),
                                            std::tuple("0.04-t", "t = 0.0", ExitCode::cannot_continue)}) {
    Scene s = pool();
    s.liquid.viscosity = formula;
    const auto [text, ended] = test::end_of(s, 0.1);
    INFO(text);
    CHECK(ended == code);
    CHECK(text.find("liquid.viscosity = \"" + Formula(formula) + "\" is -") != std::string::npos);
    CHECK(text.find(std::string(when)) != std::string::npos);
    CHECK(text.find("it must be >= 0 there") != std::string::npos);
  }
}

}  // namespace scene_formulas_tests
