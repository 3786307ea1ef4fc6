// Liquid and gas in one solve.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace two_phase_tests {
using namespace seiche;

namespace {

Scene two_phase_scene(int dim, int cells, double gas_density) {
  Scene s = test::box_scene(dim, cells);
  s.gas.present = true;
  s.gas.density = gas_density;
  return s;
}

SolidSpec rigid_sphere(int dim, double density) {
  SolidSpec ball;
  ball.name = "ball";
  ball.kind = SolidKind::rigid;
  ball.shape.kind = "sphere";
  ball.shape.center = {0.5, 0.5, dim == 3 ? 0.5 : 0.0};
  ball.shape.radius = 0.2;
  ball.shape.where = "test";
  ball.rigid.density = density;
  return ball;
}

}  // namespace

TEST_CASE("liquid and gas at rest stay at rest, whichever is heavier") {
  for (int dim : {2, 3})
    for (const double gas : {1.0, 990.0}) {
      Scene s = two_phase_scene(dim, dim == 2 ? 32 : 16, gas);
      s.gravity = {0.9, -9.5, dim == 3 ? 0.4 : 0.0};
      test::add_liquid(s, "(0.9*(0.5-x)+9.5*(y-0.48)+0.4*(0.5-z))/9.55");
      if (dim == 2) s.liquid.regions[0].shape.phi = "(0.9*(0.5-x)+9.5*(y-0.48))/9.55";
      s.time.max_step = 0.01;
      s.solver.tolerance = 1e-11;  // the bar is a speed, as in rest.cpp; pressure round-off at 1000 : 1 exceeds 1e-13
      const auto sim = make_simulation(s, Communicator());
      double fastest = 0;
      for (int n = 0; n < 50; ++n) fastest = std::max(fastest, sim->step(sim->time() + 1).max_speed);
      WARN(dim << "D, gas of " << gas << " kg/m^3: " << fastest << " m/s");
      CHECK(fastest <= 1e-10);
      CHECK(sim->stats().gas_volume + sim->stats().liquid_volume == Approx(1).epsilon(1e-9));
    }
}

// Both fluids have the same density and no tension: the interface is passive, and a neutral ball across it rests.
TEST_CASE("a neutral ball rests across the surface of a liquid under a gas as dense") {
  for (int dim : {2, 3}) {
    Scene s = two_phase_scene(dim, dim == 2 ? 32 : 16, 1000);
    test::add_liquid(s, "y-0.47");
    s.solids.push_back(rigid_sphere(dim, 1000));
    s.gravity = {0, -9.81, 0};
    s.time.max_step = 0.01;
    s.solver.tolerance = 1e-12;  // as above
    const auto sim = make_simulation(s, Communicator());
    double fastest = 0;
    for (int n = 0; n < 30; ++n) fastest = std::max(fastest, sim->step(sim->time() + 1).max_speed);
    WARN(dim << "D: " << fastest << " m/s");
    CHECK(fastest <= 1e-10);
  }
}

// A gas of almost no density acts as a free surface.
TEST_CASE("light gas leaves the liquid as a free surface does") {
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -9.81, 0};
  test::add_liquid(s, "y-0.4-0.05*cos(pi*x)");
  s.time.fixed_step = 0.005;
  std::vector<double> energy;
  for (const double gas : {0.0, 1e-3}) {
    s.gas.present = gas > 0;
    s.gas.density = gas;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 40; ++n) (void)sim->step(sim->time() + 1);
    energy.push_back(sim->stats().kinetic_energy);
  }
  WARN("kinetic energy after 0.2 s: " << energy[0] << " and " << energy[1] << " J");
  CHECK(energy[1] == Approx(energy[0]).epsilon(1e-3));
}

// Prosperetti (1981), as in validation/capillary_wave, at 16 cells per wavelength. Tension drives the fluids along the
// interface, so the second derivative of their velocity jumps. Differences that ignore this jump give an error of
// 0.024.
TEST_CASE("viscosity between two fluids slows a capillary wave as it should") {
  const double omega = 11.1366559937;
  const std::vector<std::pair<double, double>> exact{{2, -0.1620},  {4, -0.6275},  {6, 0.3430},  {8, 0.2684},
                                                     {10, -0.3346}, {12, -0.0450}, {14, 0.2353}, {16, -0.0651},
                                                     {18, -0.1289}, {20, 0.0932}};
  Scene s = two_phase_scene(2, 16, 1);
  s.domain.cells[1] = 32;
  s.domain.upper[1] = 2;
  for (SideSpec& side : s.domain.sides[0]) side.type = SideType::periodic;
  s.liquid.density = 1;
  s.liquid.surface_tension = 1;
  s.gas.viscosity = 0.0182571749236;
  s.liquid.viscosity = "0.0182571749236";
  test::add_liquid(s, "y-1+0.01*cos(2*pi*(x-1/32))");
  ProbeSpec crest;
  crest.name = "crest";
  crest.kind = ProbeKind::surface_height;
  crest.position = {0.53125, 1, 0};
  s.probes.push_back(crest);
  const auto sim = make_simulation(s, Communicator());
  double squares = 0;
  for (const auto& [t, height] : exact) {
    while (sim->time() < t / omega * (1 - 1e-12)) sim->step(t / omega);
    squares += std::pow((sim->probe(0).value - 1) / 0.01 - height, 2);
  }
  const double rms = std::sqrt(squares / double(exact.size()));
  WARN("capillary wave: " << rms << " of its height off");
  CHECK(rms < 0.022);  // second order in h; half of the error is the surface's lag of half a step
}

// Rayleigh-Taylor instability at 3 : 1, Re = 1000, initial height 0.1, t sqrt(At) = 0.5: Fourier coefficients of the
// surface height. Reference: a one-velocity code with density smoothed over 0.005 on cells of 1/128. Transporting each
// fluid by its own velocity at 64 cells makes the second and fourth coefficients too large by 8e-4 and 9e-4.
TEST_CASE("light fluid rises into one three times as dense with a round top", "[long]") {
  constexpr int columns = 32;
  constexpr double pi = 3.14159265358979323846, second = -0.0035, fourth = 0.0003;
  Scene s = two_phase_scene(2, 64, 3);
  s.domain.cells[1] = 128;
  s.domain.upper[1] = 2;
  for (SideSpec& side : s.domain.sides[0]) side.type = SideType::periodic;
  s.gravity = {0, -1, 0};
  s.time.max_step = 0.01;
  s.liquid.density = 1;
  s.liquid.viscosity = "0.001";
  s.gas.viscosity = 0.001;
  test::add_liquid(s, "y-1+0.1*cos(2*pi*x)");
  for (int n = 0; n < columns; ++n) {
    ProbeSpec height;
    height.name = "column " + std::to_string(n);
    height.kind = ProbeKind::surface_height;
    height.position = {(n + 0.5) / 64, 1, 0};
    s.probes.push_back(height);
  }
  const auto sim = make_simulation(s, Communicator());
  const double end = 0.5 * std::sqrt(2);
  while (sim->time() < end * (1 - 1e-12)) sim->step(end);
  const auto coefficient = [&](int k) {
    double sum = 0;
    for (int n = 0; n < columns; ++n) sum += 2 * sim->probe(n).value * std::cos(2 * pi * k * (n + 0.5) / 64) / columns;
    return sum;
  };
  WARN("second and fourth coefficient: " << coefficient(2) << ", " << coefficient(4));
  CHECK(std::abs(coefficient(2) - second) < 3e-4);  // less than half of these errors
  CHECK(std::abs(coefficient(4) - fourth) < 3e-4);
}

// The faces at the surface of such drops hold more gas than liquid. With the liquid's speed they had up to six times
// the energy.
TEST_CASE("drops of a cell that start in gas at rest keep their momentum and gain no energy") {
  for (int dim : {2, 3})
    for (const double gas : {0.3, 1.2, 3.0, 100.0}) {
      CAPTURE(dim, gas);
      Scene s = two_phase_scene(dim, 8, gas);
      test::make_periodic(s);
      s.liquid.density = 1;
      s.liquid.velocity = {"0.1", "0.05", dim == 3 ? "0.02" : "0"};
      test::add_liquid(s, dim == 2 ? "sqrt((x-0.52)^2+(y-0.44)^2)-0.14" : "sqrt((x-0.52)^2+(y-0.44)^2+(z-0.5)^2)-0.14");
      const auto sim = make_simulation(s, Communicator());
      const StepStats start = sim->stats(), after = sim->step(0.1);
      WARN(dim << "D, gas of " << gas << " kg/m^3: energy " << start.kinetic_energy << " to " << after.kinetic_energy
               << " J, momentum " << start.momentum[0] << " to " << after.momentum[0] << " kg m/s");
      CHECK(after.kinetic_energy <= start.kinetic_energy);
    }
}

}  // namespace two_phase_tests
