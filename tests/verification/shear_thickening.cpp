// Liquid whose viscosity rises with the shear rate.
#include <catch2/catch.hpp>

#include "scenes.h"

using namespace seiche;

// An error of the flow returns as 1 - n = -0.95 of it: without damping 28 solves settle the first step, 20 the second.
TEST_CASE("viscosity and flow of a liquid that thickens under shear settle within a few solves", "[viscous]") {
  Scene s = test::box_scene(2, 16);
  s.liquid.density = 1;
  s.liquid.rheology.model = "power_law";
  s.liquid.rheology.consistency = 1;
  s.liquid.rheology.exponent = 1.95;
  s.liquid.rheology.regularisation = 1e-4;
  s.solver.rheology_iterations = 100;
  for (auto& ends : s.domain.sides)
    for (SideSpec& side : ends) side.type = SideType::no_slip;
  s.domain.sides[1][1].type = SideType::moving_wall;
  s.domain.sides[1][1].velocity = {"1", "0", "0"};
  test::add_liquid(s, "-1");
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < 8; ++n) CHECK(sim->step(10).rheology_iterations <= (n == 0 ? 18 : 9));
}
