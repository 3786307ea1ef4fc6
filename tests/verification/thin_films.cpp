// Sub-grid gap flow: bodies near the floor of a tank on water films far thinner than a cell (docs/method.md, "Thin
// films").
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace thin_films_tests {
using namespace seiche;

namespace {

constexpr double g = 9.81, width = 0.5, thickness = 0.25;  // width and thickness of the box, m

int cells_of(int dim) {
  return dim == 2 ? 32 : 16;
}

// A box of half the tank's width, `gap` cells above the floor.
Scene box_near_floor(int dim, double density, double gap) {
  const int cells = cells_of(dim);
  Scene s = test::box_scene(dim, cells);
  s.gravity = {0, -g, 0};
  test::add_pool(s, 0.75);
  const double z = dim == 3 ? 0.5 : 0;
  const Vec3 center(0.5, 0.5 * thickness + gap / cells, z);
  s.solids.push_back(test::rigid_box("box", {width, thickness, dim == 3 ? width : 0}, center, density));
  return s;
}

double gap_of(const Simulation& sim, int dim) {
  return (sim.solids()[0].position[1] - 0.5 * thickness) * cells_of(dim);
}

double gap_after(const Scene& scene, double until) {
  const auto sim = make_simulation(scene, Communicator());
  while (sim->time() < until) (void)sim->step(until);
  return gap_of(*sim, scene.dimension);
}

}  // namespace

// At first only the film's inertia k/delta, k = rho L^3/12, counts. (k/delta) v^2/2 = F (delta - delta_0) leads to
// delta = delta_0 cosh^2(t sqrt(F/(2 k))). At 0.1 cells the box is beyond the reach of contact.
TEST_CASE("a light box lifts off a film as the film's inertia lets it") {
  Scene s = box_near_floor(2, 500, 0.1);
  s.time.max_step = 0.002;
  const double force = (1000 - 500) * g * width * thickness, k = 1000 * std::pow(width, 3) / 12;
  const double rise = gap_after(s, 0.1) - 0.1;
  const double exact = 0.1 * std::pow(std::cosh(0.1 * std::sqrt(force / (2 * k))), 2) - 0.1;
  WARN("rises by " << rise << " cells, exact " << exact << ", bar 0.1");  // the box's inertia is 4 % of the film's
  CHECK(rise == Approx(exact).epsilon(0.1));
}

TEST_CASE("no film is so thin, nor a step so short, that a light box would stick to the floor", "[long]") {
  for (double gap : {0.003, 0.02})
    for (double dt : {0.03, 0.003}) {
      Scene s = box_near_floor(2, 500, gap);
      s.time.max_step = dt;
      const double end = gap_after(s, 1);
      WARN("2D, " << gap << " cells, steps of " << dt << " s: " << end << " cells after 1 s");
      CHECK(end > 5);
    }
  const double end = gap_after(box_near_floor(3, 500, 0.02), 1);
  WARN("3D, 0.02 cells: " << end << " cells after 1 s");
  CHECK(end > 5);
}

TEST_CASE("a light box that is thrown onto the floor comes up again") {
  for (int dim : {2, 3}) {
    Scene s = box_near_floor(dim, 500, 2);
    s.solids[0].rigid.velocity[1] = -4;
    const auto sim = make_simulation(s, Communicator());
    double least = 2;
    while (sim->time() < 1) {
      (void)sim->step(1);
      least = std::min(least, gap_of(*sim, dim));
    }
    WARN(dim << "D: down to " << least << " cells, at " << gap_of(*sim, dim) << " after 1 s");
    CHECK(least < 0.5);
    CHECK(gap_of(*sim, dim) > 2);
  }
}

// Pressure acts on all of the box's surface through the film: water carries rho g V of the weight, contact the rest.
TEST_CASE("a heavy box sinks to the floor and comes to lie on it", "[long]") {
  for (int dim : {2, 3}) {
    const double volume = thickness * std::pow(width, dim - 1);
    Scene scene = box_near_floor(dim, 2000, 6.0 * cells_of(dim) / 32);
    scene.solids[0].friction = 0.3;  // without, waves that are no longer mirrored push it along the floor, 0.01 m/s
    const auto sim = make_simulation(scene, Communicator());
    test::SettledMean force{4, 8};
    double fastest = 0;
    while (sim->time() < 8) {
      const StepStats stats = sim->step(8);
      const SolidState box = sim->solids()[0];
      force.add(stats.time, stats.dt, box.force[1] / (1000 * g * volume));
      if (stats.time > 4) fastest = std::max(fastest, box.velocity.norm());
    }
    WARN(dim << "D: the water carries " << force.value() << " rho g V; " << gap_of(*sim, dim)
             << " cells above the floor, " << fastest << " m/s");
    CHECK(force.value() == Approx(1).epsilon(0.05));
    CHECK(gap_of(*sim, dim) < 0.05);  // the reach of contact
    CHECK(fastest < 1e-3);
  }
}

}  // namespace thin_films_tests
