// Elastic solids in viscous liquid that fills its box.
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

// A disc, a hundred times lighter than the liquid and far stiffer than it is loaded, held at one side.
Scene light_stiff_disc(double tolerance) {
  Scene s = box_scene(2, 16);
  add_liquid(s, "-1");
  s.liquid.density = 1;
  s.liquid.viscosity = "0.01";
  s.liquid.velocity = {"sin(6*y)", "0", "0"};
  s.solver.viscosity = ViscousSolve::coupled;
  s.solver.tolerance = tolerance;
  s.time.fixed_step = 0.02;
  SolidSpec disc = elastic_solid("disc", 0.01, {2e4, 0.45}, 0.1);
  disc.shape.kind = "sphere";
  disc.shape.center = {0.5, 0.5, 0};
  disc.shape.radius = 0.2;
  disc.slip = Slip::no_slip;
  pin(disc, {0.3, 0.35, -1}, {0.45, 0.55, 1});
  s.solids.push_back(disc);
  return s;
}

int newton_iterations_of(const Scene& s, int steps) {
  const auto sim = make_simulation(s, Communicator());
  int sum = 0;
  for (int n = 0; n < steps; ++n) sum += sim->step(1).newton_iterations;
  return sum;
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

// Errors of the liquid's solves move a light body more than Newton's method may move it in its last iteration.
TEST_CASE("a loose tolerance of the liquid's solves does not keep Newton's method from ending", "[elastic][viscous]") {
  const int loose = newton_iterations_of(light_stiff_disc(1e-4), 25);
  const int tight = newton_iterations_of(light_stiff_disc(1e-8), 25);
  WARN(loose << " iterations with a tolerance of 1e-4, " << tight << " with 1e-8");
  CHECK(loose <= 1.2 * tight);
}

// Each solve began from rest: four or five iterations in the last of a step.
TEST_CASE("bodies go on from the velocities that they had for another viscosity", "[elastic][viscous]") {
  for (int dim : {2, 3}) {
    Scene s = stirred_box(dim, ViscousSolve::coupled);
    s.liquid.rheology.model = "power_law";
    s.liquid.rheology.consistency = 50;
    s.liquid.rheology.exponent = 0.5;
    s.liquid.rheology.regularisation = 0.1;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 3; ++n) {
      const StepStats stats = sim->step(1);
      WARN(dim << "D: " << stats.rheology_iterations << " solves, " << stats.newton_iterations
               << " iterations in the last");
      CHECK(stats.rheology_iterations > 2);
      CHECK(stats.newton_iterations <= 2);
    }
  }
}

}  // namespace elastic_viscous_tests
