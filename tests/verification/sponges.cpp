// Sponges: rest stays, uniform flow decays exactly, faults stop the run.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/scene.h"
#include "rigid_scenes.h"

namespace sponges_tests {
using namespace seiche;

namespace {

SpongeSpec along(const std::string& side, double length, const Formula& rate) {
  SpongeSpec sponge;
  sponge.side = side;
  sponge.length = length;
  sponge.rate = rate;
  return sponge;
}

}  // namespace

// Damping of what gravity adds would differ along x and drive a flow of rate dt g dt = 0.1 m/s.
TEST_CASE("liquid at rest stays at rest in a sponge") {
  for (const int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 16);
    s.gravity = {0, -9.81, 0};
    test::add_pool(s, 0.5);
    s.liquid.sponges = {along("x_upper", 0.6, "50")};
    s.time.fixed_step = 0.01;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 10; ++n) CHECK(sim->step(sim->time() + 1).max_speed < 1e-9);
  }
}

// u = v + (u0 - v) exp(-r t), for steps of any length.
TEST_CASE("uniform flow approaches a sponge's velocity exactly") {
  Scene s = test::box_scene(2, 16);
  s.gravity = {0, 0, 0};
  test::add_pool(s, 2);
  for (auto& axis : s.domain.sides)
    for (auto& side : axis) side.type = SideType::periodic;
  s.liquid.velocity = {"1", "0.5", "0"};
  SpongeSpec sponge;
  sponge.rate = "3";
  sponge.velocity = {"0.2", "-0.1", "0"};
  s.liquid.sponges = {sponge};
  s.time.fixed_step = 0.02;
  const auto sim = make_simulation(s, Communicator());
  const double mass = sim->stats().momentum[0];  // 1 m/s at the start
  for (int n = 0; n < 20; ++n) {
    const StepStats stats = sim->step(sim->time() + 1);
    const double rest = std::exp(-3 * stats.time);
    CHECK(stats.momentum[0] / mass == Approx(0.2 + 0.8 * rest).epsilon(1e-10));
    CHECK(stats.momentum[1] / mass == Approx(-0.1 + 0.6 * rest).epsilon(1e-10));
    CHECK(std::abs(stats.work.lost_numerical) < 1e-9 * mass);  // what the sponge takes is booked; rounding
  }
}

TEST_CASE("a sponge whose rate is negative or not finite stops the run with its place") {
  for (const auto& [rate, text] : {std::pair{"0.1 - x", "the rate is negative"}, std::pair{"1/x", "not finite"}}) {
    Scene s = test::box_scene(2, 16);
    test::add_pool(s, 0.5);
    SpongeSpec sponge;
    sponge.rate = rate;
    s.liquid.sponges = {sponge};
    const auto sim = make_simulation(s, Communicator());
    CHECK_THROWS_WITH(sim->step(1), Catch::Contains("liquid.sponge.0") && Catch::Contains(text));
  }
}

}  // namespace sponges_tests
