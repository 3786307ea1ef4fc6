// Time-dependent gravity.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace gravity_tests {
using namespace seiche;

namespace {

SolidSpec elastic_box(const Vec3& lower, const Vec3& upper, double density) {
  SolidSpec s;
  s.name = "soft";
  s.kind = SolidKind::elastic;
  s.shape.kind = "box";
  s.shape.lower = lower;
  s.shape.upper = upper;
  s.shape.where = "test";
  s.rigid.density = density;
  s.elastic.youngs_modulus = 1e5;
  s.elastic.poisson_ratio = 0.3;
  s.elastic.element_size = 0.1;
  return s;
}

// A pool with a floating box, a box in the air and a soft one.
Scene pool() {
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.5);
  s.solids.push_back(test::rigid_box("floats", {0.2, 0.15, 0}, {0.3, 0.5, 0}, 500));
  s.solids.push_back(test::rigid_box("falls", {0.1, 0.1, 0}, {0.3, 0.8, 0}, 500));
  s.solids.push_back(elastic_box({0.6, 0.3, 0}, {0.8, 0.4, 0}, 1100));
  s.time.fixed_step = 0.005;
  return s;
}

}  // namespace

TEST_CASE("a formula without t in it gives the bits of the number") {
  const auto run = [](const Scene& s) {
    std::vector<double> all;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 20; ++n) {
      const StepStats stats = sim->step(sim->time() + 1);
      all.insert(all.end(), {stats.kinetic_energy, stats.potential_energy, stats.elastic_energy, stats.momentum[1]});
    }
    return all;
  };
  Scene formula = pool();
  formula.gravity.formula[1] = "-9.81+0*t";
  CHECK(run(pool()) == run(formula));
}

// v = a t^2/2 is exact for steps that take gravity at their midpoints.
TEST_CASE("bodies and liquid fall alike under gravity that grows") {
  for (int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 16);
    const double z = dim == 3 ? 0.2 : 0;
    s.gravity.formula = {"0.0", "-200*t", "0.0"};
    s.solids.push_back(test::rigid_box("rigid", {0.2, 0.2, z}, {0.3, 0.7, dim == 3 ? 0.5 : 0}, 500));
    s.solids.push_back(elastic_box({0.6, 0.6, dim == 3 ? 0.4 : 0}, {0.8, 0.8, dim == 3 ? 0.6 : 0}, 1100));
    s.time.scheme = TimeScheme::first_order;
    s.time.fixed_step = 0.005;
    s.time.frame_rate = 20;  // frames after whole steps
    LiquidRegionSpec drop;
    drop.shape.kind = "sphere";
    drop.shape.center = {0.45, 0.35, dim == 3 ? 0.5 : 0};
    drop.shape.radius = 0.12;
    drop.shape.where = "test";
    s.liquid.regions.push_back(drop);
    const auto sim = make_simulation(s, Communicator());
    double t = 0, speed = 0;
    for (int n = 0; n < 10; ++n) speed = sim->step(t = sim->time() + 0.005).max_speed;
    const double v = -100 * t * t;
    INFO(dim << "D: " << sim->solids()[0].velocity[1] << ", " << sim->solids()[1].velocity[1] << ", exact " << v);
    for (const SolidState& body : sim->solids()) CHECK(body.velocity[1] == Approx(v).epsilon(1e-9));
    CHECK(speed == Approx(-v).epsilon(1e-9));
  }
}

TEST_CASE("neutrally buoyant bodies stay at rest under gravity that turns and jumps") {
  Scene s = test::box_scene(2, 31);
  test::add_liquid(s, "-1");
  s.gravity.formula = {"8*sin(30*t)", "t < 0.1025 ? -9.81 : 5", "0.0"};
  s.solids.push_back(test::rigid_box("box", {0.22, 0.3, 0}, {0.3, 0.35, 0}, 1000, 25));
  s.solids.push_back(test::rigid_ball("ball", 0.13, {0.69, 0.66, 0}, 1000));
  s.solver.tolerance = 1e-13;
  s.time.fixed_step = 0.005;  // the jump lies in the middle of a step
  const auto sim = make_simulation(s, Communicator());
  double fastest = 0;
  for (int n = 0; n < 60; ++n) {
    fastest = std::max(fastest, sim->step(sim->time() + 1).max_speed);
    for (const SolidState& b : sim->solids())
      fastest = std::max({fastest, b.velocity.norm(), b.angular_velocity.norm()});
  }
  WARN(fastest << " m/s");
  CHECK(fastest <= 1e-10);  // round-off, as under steady gravity
}

TEST_CASE("gravity that flips each step leaves everything where it is") {
  Scene s = pool();
  s.gravity.formula[1] = "9.81*sign(sin(pi*t/0.005))";
  const auto sim = make_simulation(s, Communicator());
  const auto start = sim->solids();
  double fastest = 0;
  for (int n = 0; n < 200; ++n) fastest = std::max(fastest, sim->step(sim->time() + 1).max_speed);
  WARN("fastest liquid " << fastest << " m/s, a step's fall makes " << 9.81 * 0.005);
  // The first impulse is never cancelled, so free bodies drift at half its velocity.
  const double drift = 0.5 * 9.81 * 0.005 * sim->time();
  for (std::size_t k = 0; k < 3; ++k) {
    INFO(sim->solids()[k].name << " at " << sim->solids()[k].position.transpose());
    CHECK((sim->solids()[k].position - start[k].position).norm() <= 1.1 * drift);
  }
  CHECK(fastest <= 1);
}

}  // namespace gravity_tests
