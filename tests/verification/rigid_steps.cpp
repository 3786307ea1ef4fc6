// Massless bodies, and floating bodies at different step sizes.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace rigid_steps_tests {
using namespace seiche;

namespace {

// A ball in water, far from the walls compared to its size.
Scene ball_in_water(int cells, double radius, double height, double level, double ratio) {
  Scene s = test::box_scene(3, cells);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, level);
  s.solids.push_back(test::rigid_ball("ball", radius, {0.5, height, 0.5}, 1000 * ratio));
  return s;
}

// Acceleration in the first millisecond, over g.
double first_acceleration(Scene s) {
  s.time.fixed_step = 1e-3;
  const auto sim = make_simulation(s, Communicator());
  (void)sim->step(1);
  return sim->solids()[0].velocity[1] / 1e-3 / 9.81;
}

}  // namespace

// (s - 1)/(s + 1/2) = -2 for an unbounded massless sphere; walls five radii away add about 1 % to its added mass.
TEST_CASE("a massless sphere starts up with twice the acceleration of gravity") {
  const double a = first_acceleration(ball_in_water(60, 0.1, 0.475, 0.95, 1e-6));
  WARN("ratio 1e-6: a = " << a << " g, bar 2 +- 3 %");
  CHECK(a == Approx(2).epsilon(0.03));
}

// Pressures of 1e9 times the body's weight would leave only round-off of it, so such bodies count as heavier.
TEST_CASE("a sphere of density ratio 1e-9 moves as one of the least ratio, and the log says so") {
  const auto sim = make_simulation(ball_in_water(24, 0.15, 0.25, 0.75, 1e-9), Communicator());
  const auto least = make_simulation(ball_in_water(24, 0.15, 0.25, 0.75, 1e-7), Communicator());
  for (int n = 0; n < 3; ++n) (void)sim->step(0.4), (void)least->step(0.4);
  CHECK(sim->solids()[0].velocity == least->solids()[0].velocity);
  const auto notes = sim->take_warnings();
  CHECK(std::any_of(notes.begin(), notes.end(),
                    [](const std::string& n) { return n.find("is taken as") != std::string::npos; }));
}

namespace {

// Its speed is what gravity's work gives: 1/2 m_a v^2, m_a the added mass, half its displacement in unbounded liquid
// and less as it comes out. Bar for energy from nowhere: twice the error of single steps, 2.9 % of the largest kinetic
// energy. On the way up 3 % may be lost: measured are 1.7 % by the shift and 2.7 % by cells. Liquid that braked it took
// 26 %.
void check_rise(VolumeKeeping keeping) {
  Scene scene = ball_in_water(24, 0.15, 0.25, 0.75, 1e-6);
  scene.liquid.volume = keeping;
  const auto sim = make_simulation(scene, Communicator());
  double height = 0, fastest = 0, kinetic = 0, least_lost = 0, lost_below = 0, aside = 0;
  while (sim->time() < 0.4) {
    const StepStats stats = sim->step(0.4);
    const SolidState ball = sim->solids()[0];
    REQUIRE(std::isfinite(ball.velocity.norm()));
    fastest = std::max(fastest, ball.velocity.norm());
    height = std::max(height, ball.position[1]);
    kinetic = std::max(kinetic, stats.kinetic_energy);
    least_lost = std::min(least_lost, stats.work.lost_numerical);
    if (ball.position[1] >= 0.75) continue;
    lost_below = stats.work.lost_numerical;
    aside = std::max({aside, std::abs(ball.position[0] - 0.5), std::abs(ball.position[2] - 0.5)});
  }
  WARN("ratio 1e-6: rises to " << height << " m, at most " << fastest << " m/s and " << kinetic << " J; lost at least "
                               << least_lost << " J, " << lost_below << " J up to the surface");
  CHECK(height > 0.5);
  CHECK(least_lost >= -0.06 * kinetic);
  CHECK(std::abs(lost_below) <= 0.03 * kinetic);
  CHECK(aside < 1e-6);  // 1e-12 by the shift, 7e-7 by cells, since rounding grows; 1e-3 with one host a covered cell
}

}  // namespace

TEST_CASE("a massless sphere rises on by the work of gravity alone") {
  check_rise(VolumeKeeping::by_shift);
}

TEST_CASE("a massless sphere rises by gravity alone where cells carry volumes") {
  check_rise(VolumeKeeping::in_cells);
}

// x = v t - g t^2/2 up to round-off, with steps of any length.
TEST_CASE("a body that falls free follows its parabola") {
  Scene s = test::box_scene(2, 16);
  s.gravity = {0, -9.81, 0};
  s.solids.push_back(test::rigid_ball("ball", 0.1, {0.3, 0.4, 0}, 1000));
  s.solids[0].rigid.velocity = {0.5, 1.5, 0};
  const auto sim = make_simulation(s, Communicator());
  for (double until : {0.011, 0.1, 0.17, 0.3}) {
    while (sim->time() < until) (void)sim->step(until);
    const double t = sim->time();
    CHECK(sim->solids()[0].position[0] == Approx(0.3 + 0.5 * t).epsilon(1e-12));
    CHECK(sim->solids()[0].position[1] == Approx(0.4 + 1.5 * t - 9.81 / 2 * t * t).epsilon(1e-12));
  }
}

// In a full box the acceleration is nearly constant at first: x = a t^2/2 and v = a t for few steps and for many.
// Positions advanced with the velocity at the start of each step would lack 1/n of the distance after n steps.
TEST_CASE("a body let go in liquid is not late after long steps") {
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -9.81, 0};
  test::add_liquid(s, "-1");
  s.solids.push_back(test::rigid_ball("disc", 0.15, {0.5, 0.5, 0}, 2000));
  for (int steps : {1, 2, 5}) {
    s.time.fixed_step = 0.05 / steps;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < steps; ++n) (void)sim->step(0.05);
    const SolidState disc = sim->solids()[0];
    const double way = 0.5 - disc.position[1], expected = -0.5 * 0.05 * disc.velocity[1];
    WARN(steps << " steps: way " << way << " m, a t^2/2 = " << expected << " m");
    CHECK(way == Approx(expected).epsilon(0.02));  // walls three radii away change the added mass slightly
  }
}

// A disc sinks to the floor. Steps are leapfrog, x1 = x0 + dt/2 (v0 + v1), until it could touch within two steps, and
// full steps from then on. A run resumed from a checkpoint at any step gives the same bits.
TEST_CASE("leapfrog steps and whole ones go on from a checkpoint with the same bits") {
  Scene s = test::box_scene(2, 24);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.8);
  s.time.max_step = 0.02;
  s.solids.push_back(test::rigid_ball("disc", 0.15, {0.5, 0.35, 0}, 2500));
  const auto whole = make_simulation(s, Communicator());
  int by_halves = 0, as_whole = 0, touching = 0;
  for (int n = 0; n < 25; ++n) {
    const auto other = make_simulation(s, Communicator());
    other->load(whole->save());
    const SolidState before = whole->solids()[0];
    const StepStats a = whole->step(1), b = other->step(1);
    const SolidState disc = whole->solids()[0];
    CHECK(a.dt == b.dt);
    CHECK(a.kinetic_energy == b.kinetic_energy);
    CHECK(disc.position == other->solids()[0].position);
    CHECK(whole->frame_field("surface").values == other->frame_field("surface").values);
    CHECK(whole->frame_field("vel").values == other->frame_field("vel").values);
    const Vec3 off = disc.position - before.position - 0.5 * a.dt * (before.velocity + disc.velocity);
    if (disc.velocity.norm() > 1e-3) ++(off.norm() < 1e-14 ? by_halves : as_whole);  // at rest both agree
    touching += a.contacts > 0;
  }
  WARN(by_halves << " leapfrog steps, " << as_whole << " as a whole, " << touching << " in contact");
  CHECK(by_halves >= 3);
  CHECK(as_whole >= 1);
  CHECK(touching >= 3);
}

// Free-slip liquid does not feel the rotation of a disc about its centre.
TEST_CASE("liquid around a disc that moves as prescribed is the same if the disc spins") {
  std::vector<StepStats> ends;
  std::vector<Vec3> velocities;
  for (const char* degrees : {"0", "300*t"}) {
    Scene s = test::box_scene(2, 32);
    s.gravity = {0, -9.81, 0};
    s.time.fixed_step = 5e-3;
    test::add_liquid(s, "y-0.75");
    SolidSpec disc = test::rigid_ball("disc", 0.12, {0.35, 0.4, 0}, 1000);
    disc.kind = SolidKind::kinematic;
    disc.motion.translate = {"0.8*t", "0.2*t", "0"};
    disc.motion.center = disc.shape.center;
    disc.motion.degrees = degrees;
    s.solids.push_back(disc);
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 20; ++n) ends.push_back(sim->step(1));
    velocities.push_back(sim->solids()[0].velocity);
  }
  double worst = 0;
  for (std::size_t n = 0; n < 20; ++n)
    worst = std::max(worst, (ends[n + 20].momentum - ends[n].momentum).norm() / ends[n].momentum.norm());
  WARN("momentum off by " << worst);
  CHECK(worst < 0.01);  // 0.004, since the disc is not round on the grid; 0.05 if it rotated about its next position
  CHECK((velocities[0] - Vec3(0.8, 0.2, 0)).norm() < 1e-12);
  CHECK((velocities[1] - velocities[0]).norm() < 1e-12);
}

// A raft in sloshing water for 15 s: its mean height must not depend on the step size.
TEST_CASE("a raft floats equally high at Courant numbers 0.5, 1, 2 and 5", "[long]") {
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
    CHECK(fastest <= 2);  // waves of 0.04 m give a tenth of it
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  CHECK(*high - *low <= 0.01 * *low);
}

}  // namespace rigid_steps_tests
