#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace viscous_energy_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

// Irregular unresolved waves in a closed box, without forcing.
Scene unforced(double viscosity, double cfl) {
  Scene s = box_scene(2, 32);
  for (int a = 0; a < 2; ++a)
    for (SideSpec& side : s.domain.sides[a]) side.type = SideType::no_slip;
  s.liquid.density = 1;
  s.liquid.viscosity = Formula(fmt::format("{}", viscosity));
  s.liquid.velocity = {"sin(1234.5*x+777.1*y+1.3)+sin(91.7*x*y+50*x+3)", "sin(913.7*x-1311.3*y+0.4)+cos(77.7*x*y-61*y)",
                       "0"};
  s.time.cfl = cfl;
  s.time.end = 1;
  return s;
}

// Largest relative rise of kinetic energy in a step.
double largest_rise(const Scene& scene) {
  auto run = make_simulation(scene, Communicator());
  double largest = 0, before = run->stats().kinetic_energy;
  while (run->time() < scene.time.end) {
    const double now = run->step(scene.time.end).kinetic_energy;
    largest = std::max(largest, now / before - 1);
    before = now;
  }
  return largest;
}

}  // namespace

// Pressure gradients do no work on divergence-free flow, walls at rest do none, and viscosity dissipates energy.
TEST_CASE("kinetic energy of unforced viscous liquid falls in every step", "[viscous][long]") {
  for (const double viscosity : {1e-5, 1e-3, 1.0})
    for (const double cfl : {0.3, 1.0, 2.0, 4.0}) {
      CAPTURE(viscosity, cfl);
      Scene full = unforced(viscosity, cfl);
      add_liquid(full, "-1");
      CHECK(largest_rise(full) <= 0);
      full.solids = {rigid_ball("free", 0.13, {0.45, 0.55, 0}, 2)};
      full.solids[0].slip = Slip::no_slip;
      CHECK(largest_rise(full) <= 0);
      Scene surface = unforced(viscosity, cfl);
      add_liquid(surface, "y-0.6-0.1*sin(9*x)");
      CHECK(largest_rise(surface) <= 0);
    }
}

// Steps over several cells: paths extrapolated in time made energy rise by up to 520 % in a step, in most of these
// scenes, while the one of the test before passed by luck.
TEST_CASE("kinetic energy of unforced liquid falls in long steps", "[viscous]") {
  for (const double cfl : {3.0, 4.0, 8.0})
    for (const double amplitude : {0.09, 0.095, 0.103, 0.11}) {
      CAPTURE(cfl, amplitude);
      Scene surface = unforced(1e-5, cfl);
      add_liquid(surface, fmt::format("y-0.6-{}*sin(9*x)", amplitude));
      CHECK(largest_rise(surface) <= 0);
    }
}

// A wave of liquid under light gas beside an open side. It is so viscous that each step smooths it over several cells.
template <int Dim>
Scene stiff_wave(double gas_viscosity) {
  Scene s = box_scene(Dim, 8, 8);
  s.domain.upper[0] = s.domain.cells[0] = 10;
  if (Dim == 3) s.domain.upper[2] = s.domain.cells[2] = 4;
  for (int a = 0; a < Dim; ++a)
    for (SideSpec& side : s.domain.sides[a]) side.type = SideType::free_slip;
  s.domain.sides[0][0].type = SideType::no_slip;
  s.domain.sides[0][1].type = SideType::outflow;
  s.gravity = {0, -9.81, 0};
  s.liquid.viscosity = Formula("1e5");
  s.gas.present = true;
  s.gas.density = 1.2;
  s.gas.viscosity = gas_viscosity;
  add_liquid(s, Dim == 2 ? "y-3.2-1.8*sin(0.6*x)" : "y-3.2-1.8*sin(0.6*x)*cos(0.4*z)");
  return s;
}

template <int Dim>
void check_stiff_wave() {
  for (const double gas_viscosity : {0.0, 1.0}) {
    auto run = make_simulation(stiff_wave<Dim>(gas_viscosity), Communicator());
    double largest = 0;
    while (run->time() < 0.15 && largest < 100) largest = std::max(largest, run->step(0.15).max_speed);
    WARN(Dim << "D, gas of " << gas_viscosity << " Pa s: " << largest << " m/s; a free fall has 1.5");
    CHECK(largest < 10);
  }
}

TEST_CASE("viscous liquid beside light gas at an open side moves at bounded speeds", "[viscous]") {
  check_stiff_wave<2>();
  check_stiff_wave<3>();
}

// Threads that evaluated one formula at the same time overwrote each other's x: on an idle machine this changed every
// fourth run.
TEST_CASE("walls that move by formulas give the same bits in every run", "[viscous]") {
  Scene s = box_scene(3, 32);
  s.domain.upper[1] = 0.25, s.domain.cells[1] = 8;
  add_liquid(s, "-1");
  s.liquid.viscosity = Formula("10");
  for (SideSpec& side : s.domain.sides[1]) {
    side.type = SideType::moving_wall;
    side.velocity = {"sin(6*x)*cos(5*z)+x*z", "0", "cos(7*x+z)"};
  }
  s.time.fixed_step = 1e-3;
  std::vector<double> dissipated;
  for (int run = 0; run < 6; ++run)
    dissipated.push_back(make_simulation(s, Communicator())->step(1).viscous_dissipation);
  CHECK(std::equal(dissipated.begin() + 1, dissipated.end(), dissipated.begin()));
}

// A drop lies beside a sphere of a fiftieth of the gas's density, 0.64 cells a radius, which may only turn, in a
// stream. The no-slip profile in gas without a boundary layer fed its turning: +50 % a step, however short.
TEST_CASE("a light no-slip sphere does not spin up in gas of little viscosity", "[viscous]") {
  for (const double viscosity : {0.0, 1e-5, 0.02, 1.0}) {
    Scene s = box_scene(3, 4, 4);
    s.domain.cells[1] = 8, s.domain.upper[1] = 8;
    s.domain.sides[2][0].type = SideType::inflow;
    s.domain.sides[2][0].velocity = {"0", "0", "1"};
    s.domain.sides[2][1].type = SideType::outflow;
    s.liquid.density = 1;
    s.liquid.viscosity = Formula("12");
    add_liquid(s, "sqrt((x-2.4)^2+(y-2.1)^2+(z-2.7)^2)-0.9");
    s.gas.present = true;
    s.gas.density = 1.2;
    s.gas.viscosity = viscosity;
    s.solids = {rigid_ball("free", 0.635566, {2.19846, 4, 2.06497}, 0.0249675)};
    s.solids[0].slip = Slip::no_slip;
    s.solids[0].rigid.fixed_position = {true, true, true};
    s.solids[0].rigid.angular_velocity = {-1.2, 0, -1.2};
    s.time.max_step = 0.5;
    auto run = make_simulation(s, Communicator());
    double most = 0;
    for (int n = 0; n < 40; ++n) most = std::max(most, run->step(100).kinetic_energy);
    WARN("gas of " << viscosity << " Pa s: " << most << " J of some 60 J of the stream");
    CHECK(most <= 200);
  }
}

}  // namespace viscous_energy_tests
