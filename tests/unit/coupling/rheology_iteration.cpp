// When the iteration between viscosity and flow ends.
#include "coupling/solve/rheology_iteration.h"

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/step/initial_state.h"
#include "grid/loops.h"
#include "verification/scenes.h"

namespace rheology_iteration_tests {
using namespace seiche;

namespace {

// A full box of power-law liquid, and flows along its first axis.
template <int Dim>
struct Stirred {
  Setup<Dim> setup{scene(), Communicator()};
  State<Dim> state = initial_state(setup);
  TimeLevel<Dim> flow = *state.now;
  RheologyIteration<Dim> iteration{setup, state, flow};

  static Scene scene() {
    Scene s = test::box_scene(Dim, 8);
    test::add_liquid(s, "-1");
    s.liquid.rheology.model = "power_law";
    s.liquid.rheology.consistency = 1;
    s.liquid.rheology.exponent = 0.5;
    s.liquid.rheology.regularisation = 1e-3;
    s.solver.rheology_tolerance = 1e-3;
    return s;
  }
  // A solve that finds this speed everywhere.
  bool goes_on_after(double speed, bool friction_settled) {
    for_each_site(setup.domain.layout, setup.domain.layout.padded(), [&](Site f) { flow.u.at(0, f) = speed; });
    return iteration.differs_from(flow, friction_settled);
  }
};

template <int Dim>
void check_end() {
  Stirred<Dim> settled, rubbed;
  // Changes of 1, 0.1 and 0.2 of the speed.
  for (const double speed : {1.0, 1.1, 1.32}) CHECK(settled.goes_on_after(speed, true));
  CHECK_FALSE(settled.goes_on_after(1.32 * 1.0005, true));
  CHECK(settled.iteration.change_left() == 0);

  CHECK(rubbed.goes_on_after(1.0, false));
  CHECK(rubbed.goes_on_after(1.1, false));
  CHECK_FALSE(rubbed.goes_on_after(1.32, false));
  CHECK(rubbed.iteration.count() == 3);
  CHECK(rubbed.iteration.change_left() == Approx(0.22 / 1.32));
}

}  // namespace

// A soft box with a friction of 1e4 took 30 solves a step, each with 130 Newton iterations.
TEST_CASE("viscosity is not found anew for ever where friction does not settle", "[viscous][friction]") {
  check_end<2>();
  check_end<3>();
}

}  // namespace rheology_iteration_tests
