// Liquid whose viscosity rises with the shear rate.
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes.h"

namespace shear_thickening_tests {
using namespace seiche;

namespace {

// A cavity whose lid moves.
std::unique_ptr<Simulation> thickening_cavity(int most_solves) {
  Scene s = test::box_scene(2, 16);
  s.liquid.density = 1;
  s.liquid.rheology.model = "power_law";
  s.liquid.rheology.consistency = 1;
  s.liquid.rheology.exponent = 1.95;
  s.liquid.rheology.regularisation = 1e-4;
  s.solver.rheology_iterations = most_solves;
  for (auto& ends : s.domain.sides)
    for (SideSpec& side : ends) side.type = SideType::no_slip;
  s.domain.sides[1][1].type = SideType::moving_wall;
  s.domain.sides[1][1].velocity = {"1", "0", "0"};
  test::add_liquid(s, "-1");
  return make_simulation(s, Communicator());
}

int count_of_disagreements(const std::vector<std::string>& warnings) {
  return int(std::count_if(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.find("viscosity and flow do not agree after 2 solves") != std::string::npos;
  }));
}

}  // namespace

// An error of the flow returns as 1 - n = -0.95 of it: without damping 28 solves settle the first step, 20 the second.
TEST_CASE("viscosity and flow of a liquid that thickens under shear settle within a few solves", "[viscous]") {
  const auto sim = thickening_cavity(100);
  for (int n = 0; n < 8; ++n) CHECK(sim->step(10).rheology_iterations <= (n == 0 ? 18 : 9));
  CHECK(count_of_disagreements(sim->take_warnings()) == 0);
}

TEST_CASE("viscosity and flow that do not agree within the solves allowed are reported once", "[viscous]") {
  const auto sim = thickening_cavity(2);
  for (int n = 0; n < 3; ++n) (void)sim->step(10);
  CHECK(count_of_disagreements(sim->take_warnings()) == 1);
}

}  // namespace shear_thickening_tests
