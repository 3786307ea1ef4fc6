// Elastic solids whose pins move, in viscous liquid that fills its box.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "elastic_scenes.h"

namespace elastic_viscous_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

// A block off the grid's lines, its lower half pinned and moved. What the pins push out of a cell is not the flux of
// its closed faces alone (FacetFluxes).
Scene stirred_box(int dim, ViscousSolve route) {
  Scene s = box_scene(dim, dim == 2 ? 32 : 12);
  add_liquid(s, "-1");
  s.liquid.viscosity = "50";
  s.solver.viscosity = route;
  s.time.max_step = 0.01;
  const double z = dim == 3 ? 0.37 : 0;
  s.solids.push_back(elastic_box("block", {0.37, 0.38, z}, {0.62, 0.63, z + 0.25}, 1000, {1e6, 0.3}, 0.12));
  pin(s.solids.back(), {0, 0, -1}, {1, 0.51, 1});
  s.solids.back().elastic.pinned.back().motion.translate = {"0.05*sin(10*t)", "0.02*sin(10*t)", "0"};
  return s;
}

}  // namespace

TEST_CASE("viscous liquid stays free of divergence beside elastic solids whose pins move", "[elastic][viscous]") {
  for (int dim : {2, 3})
    for (const ViscousSolve route : {ViscousSolve::coupled, ViscousSolve::split}) {
      const auto sim = make_simulation(stirred_box(dim, route), Communicator());
      double worst = 0;
      for (int n = 0; n < 3; ++n) worst = std::max(worst, sim->step(1).max_divergence);
      // The solver's tolerance of 1e-8 leaves 1e-6/s of a speed of 0.5 m/s over cells of 0.03 m; 3.7/s without the flux
      // of the pins.
      WARN(dim << "D: " << worst << " 1/s, bar 1e-4");
      CHECK(worst <= 1e-4);
    }
}

}  // namespace elastic_viscous_tests
