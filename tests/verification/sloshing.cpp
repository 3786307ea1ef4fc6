// Standing gravity waves of small amplitude against linear theory: omega^2 = g k tanh(k depth).
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace sloshing_tests {
using namespace seiche;

TEST_CASE("a sloshing tank swings with the period of linear theory") {
  // L = 1, depth 0.5, first mode (wavelength 2 L): 64 cells per wavelength, amplitude 0.01 L.
  constexpr double pi = 3.14159265358979323846, g = 9.81, amplitude = 0.01;
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -g, 0};
  test::add_liquid(s, fmt::format("y - 0.5 - {}*cos(pi*x)", amplitude));
  ProbeSpec gauge;
  gauge.name = "wall";
  gauge.kind = ProbeKind::surface_height;
  gauge.position = {0.5 / 32, 0.5, 0};
  s.probes.push_back(gauge);
  const auto sim = make_simulation(s, Communicator());

  // Times at which the height at the wall crosses the mean level, by linear interpolation between steps.
  std::vector<double> passes;
  double t0 = 0, e0 = amplitude;
  while (passes.size() < 9) {
    (void)sim->step(sim->time() + 1);
    const double t1 = sim->time(), e1 = sim->probe(0).value - 0.5;
    if (e0 * e1 < 0) passes.push_back(t0 + (t1 - t0) * e0 / (e0 - e1));
    t0 = t1, e0 = e1;
  }
  const double period = (passes[8] - passes[0]) / 4, exact = 2 * pi / std::sqrt(g * pi * std::tanh(pi * 0.5));
  WARN("sloshing period " << period << " s, theory " << exact << " s, error " << 100 * (period / exact - 1) << " %");
  CHECK(std::abs(period / exact - 1) <= 0.005);
  // The first quarter period, from rest, has no delay either: half a step would be a twelfth of it. The probe is half a
  // cell from the wall, and waves of finite height are slightly faster.
  WARN("first at the level after " << passes[0] << " s, a quarter is " << exact / 4 << " s");
  CHECK(4 * passes[0] == Approx(exact).epsilon(0.01));
}

}  // namespace sloshing_tests
