// Keys of viscous liquids.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "fluid/rheology/rheology.h"
#include "unit/scene/common.h"

namespace viscosity_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string liquid(const std::string& keys) {
  return small_scene + "[liquid]\n" + keys + "\n";
}
std::string rheology(const std::string& keys) {
  return liquid("rheology = { " + keys + " }");
}

}  // namespace

TEST_CASE("viscosity is a number or a formula") {
  CHECK(parse(liquid("viscosity = 1e-3")).liquid.viscosity == "0.001");
  CHECK(parse(liquid("viscosity = \"1 + x*t\"")).liquid.viscosity == "1 + x*t");
  CHECK(parse(small_scene).liquid.viscosity == "0.0");
  CHECK(parse(small_scene).liquid.rheology.model.empty());
}

TEST_CASE("a rheology keeps its numbers through writing and reading") {
  const Scene scene =
      parse(rheology("model = \"herschel_bulkley\", consistency = 10, exponent = 0.5, yield_stress = 20, "
                     "regularisation = 1e-3"));
  const RheologySpec again = parse(write_scene(scene)).liquid.rheology;
  CHECK(again.model == "herschel_bulkley");
  CHECK(again.consistency == 10);
  CHECK(again.exponent == 0.5);
  CHECK(again.yield_stress == 20);
  CHECK(again.regularisation == 1e-3);
  CHECK_THAT(write_scene(scene), !Contains("viscosity = 0"));
  const Scene carreau =
      parse(rheology("model = \"carreau\", viscosity_zero = 3, viscosity_infinity = 0, time = 2, exponent = 0.4"));
  CHECK(write_scene(parse(write_scene(carreau))) == write_scene(carreau));
  CHECK_FALSE(carreau.liquid.rheology.regularisation);
}

// sqrt(g / L) = sqrt(9.81 / 1) in the unit box of the small scene; its run takes 1 s.
TEST_CASE("the regularisation that a scene leaves out is derived from it and written") {
  const std::string text = rheology("model = \"bingham\", viscosity = 1, yield_stress = 2");
  const Scene scene = parse(text);
  CHECK(scene.liquid.rheology.regularisation.value() == Approx(1e-3 * std::sqrt(9.81)));
  CHECK_THAT(write_scene(scene), Contains("regularisation = 0.0031"));
  const Scene weightless = parse("gravity = [0, 0, 0]\n" + text, {{"time.end", "0.25"}});
  CHECK(weightless.liquid.rheology.regularisation.value() == Approx(4e-3));
}

TEST_CASE("wrong viscosities and rheologies are refused with what would be right") {
  const std::string bingham = "model = \"bingham\", viscosity = 1, yield_stress = ";
  const struct {
    std::string text, expected;
  } rows[] = {
      {liquid("viscosity = -1"), "scene.toml:7: liquid.viscosity must be >= 0 Pa s; it is -1"},
      {liquid("viscosity = \"-1\""), "liquid.viscosity: the expression '-1' is -1"},
      {liquid("viscosity = nan"), "liquid.viscosity must be >= 0 Pa s; it is nan"},
      {liquid("viscosity = inf"), "liquid.viscosity must be >= 0 Pa s; it is inf"},
      {liquid("viscosity = \"1/0\""), "liquid.viscosity: the expression '1/0'"},
      {liquid("viscosity = true"), "liquid.viscosity must be a number or an expression in quotes (Pa s)"},
      {liquid("rheology = \"bingham\""), "liquid.rheology must be a table"},
      {rheology("model = \"bingam\""),
       "liquid.rheology.model must be \"bingham\", \"herschel_bulkley\", \"carreau\" or \"power_law\", not the text "
       "\"bingam\"; "
       "did "
       "you mean \"bingham\"?"},
      {rheology("viscosity = 1"), "[liquid.rheology] needs 'model'"},
      {rheology("model = \"bingham\", viscosity = 1"),
       "[liquid.rheology] needs 'yield_stress' with model = \"bingham\""},
      {rheology(bingham + "-1"), "liquid.rheology.yield_stress must be >= 0 Pa; it is -1"},
      {rheology(bingham + "nan"), "liquid.rheology.yield_stress must be >= 0 Pa; it is nan"},
      {rheology(bingham + "1, regularisation = 0"), "liquid.rheology.regularisation must be > 0 1/s; it is 0"},
      {rheology(bingham + "1, exponent = 1"),
       "'exponent' in [liquid.rheology] is only for model = \"herschel_bulkley\", \"carreau\" or \"power_law\""},
      {rheology(bingham + "1e14, regularisation = 1e-4"),
       "the viscosity at rest is 1e+18 Pa s; it must be at most 1e+15"},
      {rheology("model = \"power_law\", consistency = 1, exponent = 0"), "exponent must be > 0 and <= 10; it is 0"},
      {rheology("model = \"power_law\", consistency = 1, exponent = -0.5"),
       "exponent must be > 0 and <= 10; it is -0.5"},
      {rheology("model = \"power_law\", consistency = 0, exponent = 1"), "consistency must be > 0"},
      {rheology("model = \"carreau\", viscosity_zero = 1, viscosity_infinity = 0, time = 0, exponent = 1"),
       "liquid.rheology.time must be > 0 s; it is 0"},
      {liquid("viscosity = 1\nrheology = { model = \"bingham\", viscosity = 1, yield_stress = 1 }"),
       "scene.toml:7: liquid.viscosity and liquid.rheology exclude each other"},
      {small_scene + "[solver]\nviscosity = \"both\"\n", "solver.viscosity must be \"auto\", \"split\" or \"coupled\""},
      {small_scene + "[solver]\nrheology_iterations = 0\n", "solver.rheology_iterations must be >= 1"},
      {small_scene + "[solver]\nrheology_tolerance = 0\n", "solver.rheology_tolerance must be > 0"},
  };
  for (const auto& row : rows) {
    INFO(row.text);
    const std::string message = fault(row.text);
    CHECK_THAT(message, StartsWith("scene.toml"));
    CHECK_THAT(message, Contains(row.expected));
  }
}

TEST_CASE("how viscosity is solved for and its frames are scenes") {
  const Scene scene = parse(small_scene + "[solver]\nviscosity = \"split\"\n[output]\nframes = [\"viscosity\"]\n");
  CHECK(scene.solver.viscosity == ViscousSolve::split);
  CHECK(scene.output.frames == std::vector<std::string>{"viscosity"});
}

}  // namespace viscosity_tests
