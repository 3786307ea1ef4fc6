// Separating walls: liquid that may separate from walls and solids.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "elastic_scenes.h"
#include "scenes.h"

namespace separation_tests {
using namespace seiche;

namespace {

// A block of liquid below the lid.
Scene hanging_block(int dim, int cells) {
  Scene s = test::box_scene(dim, cells);
  s.gravity = {0, -9.81, 0};
  LiquidRegionSpec block;
  block.shape.kind = "box";
  block.shape.lower = {0.25, 0.625, 0.25};
  block.shape.upper = {0.75, 1, 0.75};
  if (dim == 2) block.shape.lower[2] = block.shape.upper[2] = 0;
  block.shape.where = "test";
  s.liquid.regions.push_back(block);
  s.time.fixed_step = 0.005;
  return s;
}

// Height of the centre of mass, m.
double height(const Simulation& sim) {
  return sim.stats().potential_energy / (9.81 * 1000 * sim.stats().liquid_volume);
}

double fall_after(const Scene& s, int steps) {
  const auto sim = make_simulation(s, Communicator());
  const double start = height(*sim);
  for (int n = 0; n < steps; ++n) (void)sim->step(sim->time() + 1);
  return start - height(*sim);
}

}  // namespace

TEST_CASE("a block of liquid under the lid falls freely where liquid may part, and hangs where it may not") {
  for (int dim : {2, 3}) {
    Scene s = hanging_block(dim, dim == 2 ? 32 : 16);
    // The surface moves with the velocity at the start of each step, so its fall is g dt^2 n (n - 1)/2.
    const int steps = 26;
    const double free_fall = 9.81 * 0.005 * 0.005 * steps * (steps - 1) / 2;
    const double hanging = fall_after(s, steps);
    s.liquid.separates = true;
    const double falling = fall_after(s, steps);
    WARN(dim << "D: fall " << falling << " m, free fall " << free_fall << ", where it hangs " << hanging);
    // A gap becomes air when it is half a cell wide, one row of cells at a time.
    CHECK(std::abs(falling - free_fall) <= 0.15 * s.domain.cell_size);
    CHECK(hanging < 0.85 * free_fall);  // it flows down at the sides
  }
}

TEST_CASE("no pressure pulls at walls and solids, and liquid at rest stays at rest") {
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -9.81, 0};
  LiquidRegionSpec pool;
  pool.shape.kind = "box";
  pool.shape.upper = {1, 0.6, 0};
  pool.shape.where = "test";
  s.liquid.regions.push_back(pool);
  s.liquid.separates = true;
  s.solver.tolerance = 1e-13;
  const auto sim = make_simulation(s, Communicator());
  double fastest = 0;
  for (int n = 0; n < 20; ++n) fastest = std::max(fastest, sim->step(sim->time() + 1).max_speed);
  CHECK(fastest <= 1e-10);
}

TEST_CASE("pressures of a splash in a lidded box never pull where liquid may part") {
  Scene s = test::box_scene(2, 32);
  s.gravity = {6, 9.81, 0};  // upwards: the liquid on the floor falls to the lid and splashes
  LiquidRegionSpec pool;
  pool.shape.kind = "box";
  pool.shape.upper = {0.5, 0.6, 0};
  pool.shape.where = "test";
  s.liquid.regions.push_back(pool);
  s.liquid.separates = true;
  const auto sim = make_simulation(s, Communicator());
  double least = 0;
  for (int n = 0; n < 60; ++n) {
    (void)sim->step(sim->time() + 1);
    double lowest = 0, highest = 0;
    const FrameField field = sim->frame_field("pressure");
    for (int i = 0; i < 32 * 32; ++i) {
      const bool at_wall = i % 32 == 0 || i % 32 == 31 || i < 32 || i >= 31 * 32;
      highest = std::max<double>(highest, field.values[i]);
      if (at_wall) lowest = std::min<double>(lowest, field.values[i]);
    }
    least = std::min(least, lowest / std::max(highest, 1.0));
  }
  WARN("lowest pressure over the highest: " << least);
  CHECK(least >= -2e-7);  // ten solver tolerances plus the frame's single precision
  CHECK(std::abs(sim->stats().liquid_volume / 0.3 - 1) < 0.02);
}

namespace {

// A block beside a tangentially moving wall, periodic across.
Scene block_at_moving_wall(const Formula& viscosity) {
  Scene s = test::box_scene(2, 20);
  s.domain.cells[1] = 19, s.domain.upper[1] = 0.95;
  s.gravity = {0, -9.81, 0};
  s.domain.sides[0][0].type = SideType::moving_wall;
  s.domain.sides[0][0].velocity[1] = "0.4527";
  for (SideSpec& side : s.domain.sides[1]) side.type = SideType::periodic;
  LiquidRegionSpec block;
  block.shape.kind = "box";
  block.shape.upper = {0.66147, 0.775594, 0};
  block.shape.where = "test";
  s.liquid.regions.push_back(block);
  s.liquid.separates = true;
  s.liquid.viscosity = viscosity;
  return s;
}

}  // namespace

TEST_CASE("viscous liquid finds which cells part") {
  const auto sim = make_simulation(block_at_moving_wall("1+0.5*sin(10*x)"), Communicator());
  while (sim->time() < 0.2241) {
    const StepStats s = sim->step(0.2241);
    CHECK(s.separation_error == 0);
    CHECK(s.rejected == 0);
  }
}

// The net flux of a cell that has parted from an elastic body must be that of its row while it has one.
TEST_CASE("liquid finds which cells part from a light elastic body") {
  Scene s = test::box_scene(2, 20);
  s.gravity = {0, -9.81, 0};
  test::add_liquid(s, "y-0.6");
  s.liquid.separates = true;
  s.solids.push_back(test::elastic_solid("disc", 50, {1e4, 0.3}, 0.05));
  s.solids[0].shape.kind = "sphere";
  s.solids[0].shape.center = {0.5, 0.4, 0};
  s.solids[0].shape.radius = 0.15;
  s.solids[0].rigid.velocity = {0.5, -1, 0};
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 0.2) CHECK(sim->step(0.2).separation_error == 0);
}

}  // namespace separation_tests
