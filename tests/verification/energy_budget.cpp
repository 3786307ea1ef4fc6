// Solves that blow up are rejected and told: operators made wrong on purpose, on any number of ranks.
#include "coupling/report/energy_budget.h"
#include "base/scene.h"
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/step/initial_state.h"
#include "coupling/step/step.h"

#include <catch2/catch.hpp>

#include "coupling/report/measures.h"
#include "coupling/state/operator_perturbation.h"
#include "scenes.h"
#include "unit/coupling/end.h"

using namespace seiche;
using Catch::Matchers::Contains;

namespace {

// A pool that drifts at 1 m/s between periodic sides, g = 10 m/s^2.
Scene drifting_pool(int dim) {
  Scene s = test::box_scene(dim, 8);
  s.domain.sides[0][0].type = s.domain.sides[0][1].type = SideType::periodic;
  s.gravity = {0, -10, 0};
  s.liquid.velocity[0] = "1";
  s.time.cfl = 2;
  test::add_liquid(s, "y-0.5");
  return s;
}

template <int Dim>
StepStats measured(const Setup<Dim>& setup, const State<Dim>& state, const NodeField<Dim>& psi) {
  StepStats stats;
  measure_fluids(setup, state, psi, stats);
  return stats;
}

// A sound step, and the same one with velocities a thousand times as high.
template <int Dim>
void check_blown_up() {
  const Setup<Dim> setup(drifting_pool(Dim), Communicator());
  const State<Dim> start = initial_state(setup);
  const NodeField<Dim> psi = setup.solids.measure(place_bodies(start), 0).psi;
  Phases phases;
  Attempt<Dim> a = attempt_step(setup, start, 0.05, phases);
  REQUIRE(a.failure.empty());
  const auto fault = [&] {
    a.stats = measured(setup, a.state, a.geometry.psi);
    return fault_of_energy(setup, start, measured(setup, start, psi), psi, a);
  };
  CHECK(fault().empty());
  TimeLevel<Dim> blown = *a.state.now;
  for (int axis = 0; axis < Dim; ++axis)
    for (double& u : blown.u[axis]) u *= 1000;
  a.state.now = std::make_shared<TimeLevel<Dim>>(blown);
  CHECK_THAT(fault(), Contains("kinetic energy grows from") && Contains("it could draw on"));
}

// A gradient c times too large throws the pool up by (c - 1) g dt.
std::unique_ptr<Simulation> perturbed(int dim, double factor) {
  OperatorPerturbation wrong;
  wrong.pressure_gradient = factor;
  return make_simulation(drifting_pool(dim), Communicator(), wrong);
}

}  // namespace

TEST_CASE("velocities a thousand times too high in one step are a fault, sound ones are not", "[ranks]") {
  SECTION("2D") {
    check_blown_up<2>();
  }
  SECTION("3D") {
    check_blown_up<3>();
  }
}

TEST_CASE("steps that blow up however short they are end the run with the energies", "[ranks]") {
  const int dim = GENERATE(2, 3);
  const auto sim = perturbed(dim, 1e4);
  try {
    (void)sim->step(1);
    FAIL("the step was accepted");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::cannot_continue);
    CHECK_THAT(error.what(), Contains("kinetic energy grows from") && Contains("after 7 halvings"));
  }
}
