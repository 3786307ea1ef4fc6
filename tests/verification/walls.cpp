// Semi-Lagrangian paths beside walls that move tangentially and through outflow sides, against exact flows.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace walls_tests {
using namespace seiche;

namespace {

// A row of eddies between two walls, all carried along with `speed`, after one period (1 s).
FrameField eddies(int cells, double speed) {
  Scene s = test::box_scene(2, cells);
  s.domain.sides[0][0].type = s.domain.sides[0][1].type = SideType::periodic;
  for (SideSpec& wall : s.domain.sides[1]) wall = {SideType::moving_wall, {fmt::format("{}", speed), "0", "0"}, "0"};
  test::add_liquid(s, "-1");
  s.liquid.density = 1;
  s.liquid.viscosity = "0.01";
  s.liquid.velocity = {fmt::format("{}+0.2*pi*sin(2*pi*x)*sin(2*pi*y)", speed), "-0.4*pi*cos(2*pi*x)*sin(pi*y)^2", "0"};
  s.time.frame_rate = 1;
  s.time.fixed_step = 0.5 / cells;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 1) (void)sim->step(1);
  return sim->frame_field("vel");
}

struct FrameErrors {
  double all = 0, beside_walls = 0;  // m/s, root mean squares
};

// Differences between eddies at rest and eddies carried once around.
FrameErrors carried_eddies(int cells) {
  constexpr double speed = 1;
  const FrameField rest = eddies(cells, 0), carried = eddies(cells, speed);
  FrameErrors e;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i)
      for (int a = 0; a < 2; ++a) {
        const std::size_t n = 3 * std::size_t(i + cells * j) + std::size_t(a);
        const double d = std::pow(double(carried.values[n]) - double(rest.values[n]) - (a == 0 ? speed : 0), 2);
        e.all += d / (2.0 * cells * cells);
        if (j == 0 || j == cells - 1) e.beside_walls += d / (4.0 * cells);
      }
  return {std::sqrt(e.all), std::sqrt(e.beside_walls)};
}

// Liquid rises between walls that move with it, driven by inflow. Largest distance (cells) of its surface from a plane
// that rises alike.
double wrinkle(int dim, const Formula& viscosity, double cfl) {
  constexpr int cells = 16;
  Scene s = test::box_scene(dim, cells);
  if (dim == 3) s.domain.cells[2] = 4, s.domain.upper[2] = 0.25;
  for (int a = 0; a < dim; ++a)
    for (SideSpec& side : s.domain.sides[a]) side = {SideType::moving_wall, {"0", "1", "0"}, "0"};
  s.domain.sides[1][0] = {SideType::inflow, {"0", "1", "0"}, "0"};
  s.domain.sides[1][1] = {SideType::outflow, {"0", "0", "0"}, "0"};
  test::add_liquid(s, "y-0.3");
  s.liquid.velocity[1] = "1";
  s.liquid.viscosity = viscosity;
  s.time.cfl = cfl;
  s.time.frame_rate = 1;
  constexpr double end = 0.4;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < end) (void)sim->step(end);
  const FrameField phi = sim->frame_field("surface");
  double most = 0;
  for (int n = 0; n < cells * s.domain.cells[2]; ++n) {
    const int i = n % cells, k = n / cells;
    for (int j = 0; j + 1 < cells; ++j) {
      const double a = phi.values[std::size_t(i + cells * (j + cells * k))],
                   b = phi.values[std::size_t(i + cells * (j + 1 + cells * k))];
      if ((a < 0) != (b < 0)) most = std::max(most, std::abs(j + 0.5 + a / (a - b) - (0.3 + end) * cells));
    }
  }
  return most;
}

}  // namespace

// Frames are in single precision.
TEST_CASE("liquid that moves with its walls has no wrinkle beside them") {
  for (const char* viscosity : {"0", "1", "100"})
    for (const double cfl : {1.0, 2.0}) CHECK(wrinkle(2, viscosity, cfl) < 1e-4);
  CHECK(wrinkle(3, "1", 1) < 1e-4);
}

// Paths cross up to half a cell a step beside walls that move with the eddies. In the eddies' frame the walls rest.
TEST_CASE("eddies beside moving walls are those beside walls at rest") {
  const FrameErrors coarse = carried_eddies(16), fine = carried_eddies(32);
  WARN("16, 32 cells: " << coarse.all << ", " << fine.all << " m/s, beside the walls " << coarse.beside_walls << ", "
                        << fine.beside_walls);
  CHECK(test::order(coarse.all, fine.all) > 1.9);
  CHECK(test::order(coarse.beside_walls, fine.beside_walls) > 1.9);
}

// Layers of different speeds enter and leave: u = 1 + sin(2 pi y)/2, p = 0. Frames are in single precision.
TEST_CASE("a shear layer leaves through an outflow side as it came") {
  constexpr int cells = 16;
  const std::string profile = "1+0.5*sin(2*pi*y)";
  Scene s = test::box_scene(2, cells);
  s.domain.sides[1][0].type = s.domain.sides[1][1].type = SideType::periodic;
  s.domain.sides[0][0] = {SideType::inflow, {profile, "0", "0"}, "0"};
  s.domain.sides[0][1].type = SideType::outflow;
  test::add_liquid(s, "-1");
  s.liquid.velocity[0] = profile;
  s.time.frame_rate = 1;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 2) (void)sim->step(2);
  const FrameField u = sim->frame_field("vel");
  double worst = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const std::size_t n = 3 * std::size_t(i + cells * j);
      const double exact = 1 + 0.5 * std::sin(2 * 3.14159265358979 * (j + 0.5) / cells);
      worst = std::max({worst, std::abs(u.values[n] - exact), std::abs(double(u.values[n + 1]))});
    }
  WARN("largest error " << worst << " m/s");
  CHECK(worst < 1e-6);
}

}  // namespace walls_tests
