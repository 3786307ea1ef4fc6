// Solves that blow up are rejected and reported: operators perturbed on purpose, on any number of ranks.
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

namespace energy_budget_tests {
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
  measure_fluids(setup.domain, setup.fluids, state, psi, stats);
  return stats;
}

// A correct step passes; the same step with velocities scaled by 1000 fails.
template <int Dim>
void check_blown_up() {
  const Setup<Dim> setup(drifting_pool(Dim), Communicator());
  const State<Dim> start = initial_state(setup);
  const NodeField<Dim> psi = setup.solids.geometry.measure(place_bodies(start), 0).psi;
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
  CHECK_THAT(fault(), Contains("kinetic energy grows from") && Contains("can supply no more than"));
}

// Half of a unit box of liquid, 500 kg with 250 J, cells of 1/8 m: what is lifted by one of them takes 625 J. Beyond
// 875 J and the works, energy comes from nowhere.
template <int Dim>
void check_works() {
  const Setup<Dim> setup(drifting_pool(Dim), Communicator());
  State<Dim> start = initial_state(setup);
  const StepStats before = measured(setup, start, setup.solids.geometry.measure(place_bodies(start), 0).psi);
  Attempt<Dim> a;
  a.state.phi = start.phi;
  a.state.dt_now = 0.05;
  a.stats = before;
  const auto fault = [&](std::int64_t step, double created, double work) {
    start.step = step;
    a.state.work.lost_numerical = -created;
    a.state.work.sides = work;
    return fault_of_works(setup.domain, setup.fluids, setup.solids, start, before, a);
  };
  CHECK(fault(10, 870, 0).empty());
  CHECK_THAT(fault(10, 880, 0), Contains("come from nowhere; there were 250"));
  CHECK(fault(10, 880, -20).empty());
  CHECK(fault(2, 1e6, 0).empty());
}

// A gradient scaled by c > 1 throws the pool up at (c - 1) g dt.
std::unique_ptr<Simulation> perturbed(int dim, double factor) {
  OperatorPerturbation wrong;
  wrong.pressure_gradient = factor;
  return make_simulation(drifting_pool(dim), Communicator(), wrong);
}

// A drop that drifts at 1 m/s and falls freely with c = 20 times the gravity that the budget knows, 10 m/s^2, in steps
// of 0.02 s: v(t) = -c g t.
constexpr double wrong_gravity = 20;

std::unique_ptr<Simulation> falling_drop(int dim) {
  Scene s = test::box_scene(dim, 8);
  test::make_periodic(s);
  s.gravity = {0, -10, 0};
  s.liquid.velocity[0] = "1";
  s.time.fixed_step = 0.02;
  s.time.cfl = 4;
  test::add_liquid(s, dim == 2 ? "sqrt((x-0.5)^2+(y-0.5)^2)-0.3" : "sqrt((x-0.5)^2+(y-0.5)^2+(z-0.5)^2)-0.3");
  OperatorPerturbation wrong;
  wrong.gravity = wrong_gravity;
  return make_simulation(s, Communicator(), wrong);
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

TEST_CASE("energy that no work accounts for is a fault once it exceeds all there was", "[ranks]") {
  SECTION("2D") {
    check_works<2>();
  }
  SECTION("3D") {
    check_works<3>();
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

// The budget has 2 (|u| + 2 g dt + 1e-3 h/dt) m/s. A whole first step would come to |(1, 4)| = 4.12 against 2.81 m/s,
// half of it to |(1, 2)| = 2.24 against 2.43 m/s.
TEST_CASE("half a step rescues a run whose step gains more energy than there is", "[ranks]") {
  const int dim = GENERATE(2, 3);
  const auto sim = falling_drop(dim);
  (void)sim->take_warnings();
  const StepStats first = sim->step(1);
  CHECK(first.rejected == 1);
  CHECK(first.dt == 0.01);
  CHECK(sim->time() == first.dt);
  const std::vector<std::string> warnings = sim->take_warnings();
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0],
             Contains("step 1 of 0.02 s at time 0 s: kinetic energy grows from") && Contains("trying half the step"));
  StepStats last = first;
  for (int step = 2; step <= 6; ++step) last = sim->step(1);  // the run goes on
  CHECK(last.step == 6);
  // Mean velocity of the drop in free fall. Transport of the drop's surface changes its mass by thousandths.
  CHECK(last.momentum[1] / last.momentum[0] == Approx(-wrong_gravity * 10 * sim->time()).epsilon(0.01));
}

// The first step is taken twice, the second time from the flow of the trial. A divergence scaled by 13 doubles the
// energy that the trial gained. The budget is that of the initial state: 2 (|u| + 2 g T) m/s, T at most 2.25 dt.
TEST_CASE("what a trial of the first step gained is not gained again", "[ranks]") {
  const int dim = GENERATE(2, 3);
  OperatorPerturbation wrong;
  wrong.divergence = 13;
  const auto sim = make_simulation(drifting_pool(dim), Communicator(), wrong);
  const double mass = 1000 * sim->stats().liquid_volume, largest_mass = 1.1 * mass;  // the surface moves by half a cell
  const StepStats first = sim->step(1);
  CHECK(first.rejected > 0);
  const double gain = 2 * 10 * 2.25 * first.dt + 1e-3 / 8 / first.dt;
  CHECK(first.kinetic_energy <= 2 * std::pow(std::sqrt(mass) + std::sqrt(largest_mass) * gain, 2));
}

}  // namespace energy_budget_tests
