// Massless bodies, and the same float at any step size.
#include <catch2/catch.hpp>

#include "rigid_scenes.h"

using namespace seiche;

// (s - 1)/(s + 1/2) = -2 for an unbounded massless sphere; walls five radii away add about 1 % to its added mass.
TEST_CASE("a massless sphere starts up with twice the acceleration of gravity and rises on") {
  for (double ratio : {1e-6, 1e-9}) {
    Scene s = test::box_scene(3, 60);
    s.gravity = {0, -9.81, 0};
    test::add_pool(s, 0.95);
    s.solids.push_back(test::rigid_ball("ball", 0.1, {0.5, 0.475, 0.5}, 1000 * ratio));
    s.time.fixed_step = 1e-3;
    const auto sim = make_simulation(s, Communicator());
    (void)sim->step(1);
    const double a = sim->solids()[0].velocity[1] / 1e-3 / 9.81;
    WARN("ratio " << ratio << ": a = " << a << " g, bar 2 +- 3 %");
    CHECK(a == Approx(2).epsilon(0.03));
  }
}

TEST_CASE("massless spheres rise on without blowing up") {
  for (double ratio : {1e-6, 1e-9}) {
    Scene s = test::box_scene(3, 24);
    s.gravity = {0, -9.81, 0};
    test::add_pool(s, 0.75);
    s.solids.push_back(test::rigid_ball("ball", 0.15, {0.5, 0.25, 0.5}, 1000 * ratio));
    const auto sim = make_simulation(s, Communicator());
    double height = 0.25, fastest = 0;
    while (sim->time() < 0.4) {
      (void)sim->step(0.4);
      const SolidState ball = sim->solids()[0];
      REQUIRE(std::isfinite(ball.velocity.norm()));
      fastest = std::max(fastest, ball.velocity.norm());
      height = std::max(height, ball.position[1]);
    }
    WARN("ratio " << ratio << ": rises to " << height << " m, at most " << fastest << " m/s");
    CHECK(height > 0.5);
    CHECK(fastest <= std::sqrt(2 * 2 * 9.81 * 0.75));  // 2 g over the depth
  }
}

// A raft among sloshing water: 15 s of waves that its time-mean height must not depend on.
TEST_CASE("a raft floats equally high at Courant numbers 0.5, 1, 2 and 5") {
  std::vector<double> heights;
  for (double cfl : {0.5, 1.0, 2.0, 5.0}) {
    Scene s = test::box_scene(2, 40);
    s.gravity = {0, -9.81, 0};
    s.time.cfl = cfl;
    test::add_liquid(s, "y - 0.45 - 0.04*cos(3.14159265*x)");
    s.solids.push_back(test::rigid_box("raft", {0.3, 0.15, 0}, {0.45, 0.47, 0}, 500, 5));
    const auto sim = make_simulation(s, Communicator());
    test::SettledMean height{2, 15};
    double fastest = 0;
    while (sim->time() < 15) {
      const StepStats step = sim->step(15);
      height.add(step.time, step.dt, sim->solids()[0].position[1]);
      fastest = std::max(fastest, step.max_speed);
    }
    heights.push_back(height.value());
    WARN("cfl " << cfl << ": mean height " << height.value() << " m, " << sim->step_count() << " steps, at most "
                << fastest << " m/s");
    CHECK(fastest <= 2);  // waves of 0.04 m make a tenth of it
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  CHECK(*high - *low <= 0.01 * *low);
}
