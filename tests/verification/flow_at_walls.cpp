// Fluxes of cut no-slip faces where viscosity stops the flow within one step.
#include <catch2/catch.hpp>

#include "scenes.h"

namespace flow_at_walls_tests {
using namespace seiche;

namespace {

// A light box, turned by 45 degrees, set off in a box of liquid so stiff that shear crosses half of it in a step.
Scene stopped_box(int dim) {
  Scene s = test::box_scene(dim, 16);
  s.gravity = {0, 0, 0};
  s.liquid.viscosity = "3000";
  s.time.fixed_step = 0.01;  // mu dt/(rho h^2) = 8
  s.time.end = 0.02;
  test::add_liquid(s, "-1");
  s.solids.emplace_back();
  SolidSpec& box = s.solids.back();
  box.name = "box";
  box.kind = SolidKind::rigid;
  box.slip = Slip::no_slip;
  box.shape.kind = "box";
  box.shape.where = "test";
  box.shape.lower = {-0.2, -0.3, dim == 3 ? -0.2 : 0.0};
  box.shape.upper = {0.2, 0.3, dim == 3 ? 0.2 : 0.0};
  box.shape.transform.rotate.degrees = 45;
  box.shape.transform.translate = {0.5, 0.5, dim == 3 ? 0.5 : 0.0};
  box.rigid.density = 76;
  box.rigid.velocity = {0.1, 0, 0};
  return s;
}

}  // namespace

// With fluxes of the flow before the step, the box kept 78 times the energy after the first step (2D), and lost nearly
// all of that in the second one without heat: relative to it the liquid had moved tens of times as fast before.
TEST_CASE("cut faces of a body that stiff liquid stops take their flux from the flow of the end", "[viscous]") {
  for (const int dim : {2, 3}) {
    const Scene s = stopped_box(dim);
    const auto sim = make_simulation(s, Communicator());
    const double start = sim->stats().kinetic_energy;
    const StepStats first = sim->step(s.time.end), second = sim->step(s.time.end);
    WARN(dim << "D: " << start << " J at the start, " << first.kinetic_energy << " J and " << first.viscous_dissipation
             << " W after a step; the second loses " << second.work.lost_viscous << " J, " << second.work.lost_numerical
             << " J numerically");
    CHECK(std::abs(second.work.lost_numerical) < 0.1 * first.kinetic_energy);
  }
}

}  // namespace flow_at_walls_tests
