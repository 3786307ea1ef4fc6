// Waves that a piston makes and a sponge absorbs: their height against linear theory, and what comes back.
#include <catch2/catch.hpp>

#include <complex>

#include "base/scene.h"
#include "scene/waves.h"
#include "verification/scenes.h"

namespace wave_tank_tests {
using namespace seiche;

namespace {

using Complex = std::complex<double>;
constexpr double g = 9.81, depth = 1, height = 0.04;

// Liquid 1 m deep and 18 m long with 16 cells a metre, a piston at 0.5 m, a beach on the last 6 m.
Scene tank(double period, double rate) {
  Scene s = test::box_scene(2, 1);
  s.domain.cell_size = 0.0625;
  s.domain.cells = {288, 24, 1};
  s.domain.upper = {18, 1.5, 0};
  s.gravity = {0, -g, 0};
  s.time.max_step = 0.02;
  test::add_liquid(s, "y - 1");
  SpongeSpec beach;
  beach.side = "x_upper";
  beach.length = 6;
  beach.rate = fmt::format("{}", rate);
  s.liquid.sponges = {beach};
  SolidSpec paddle;
  paddle.name = "paddle";
  paddle.kind = SolidKind::kinematic;
  paddle.shape.kind = "box";
  paddle.shape.where = "test";
  paddle.shape.lower = {-1, -1, 0};
  paddle.shape.upper = {0.5, 3, 0};
  WavesSpec waves;
  waves.depth = depth;
  waves.height = height;
  waves.period = period;
  const PaddleTerm term = paddle_terms(waves, g)[0];
  paddle.motion.translate[0] = fmt::format("(t<{0:.17g}?0.5-0.5*cos(pi*t/{0:.17g}):1)*{1:.17g}*sin({2:.17g}*t)",
                                           2 * period, term.amplitude, term.frequency);
  s.solids.push_back(paddle);
  return s;
}

struct Waves {
  double height, reflected;  // m; amplitude over that of the waves that come
};

// Amplitudes of waves in both directions from the levels at two places, a quarter of a wave apart: Goda and Suzuki,
// Estimation of incident and reflected waves in random wave experiments (1976). Over the last three periods.
Waves measure(const Scene& scene, double period, double end) {
  const double w = 2 * M_PI / period, k = wave_number(w, g, depth), apart = M_PI / 2 / k;
  Scene s = scene;
  for (const double x : {6.0, 6.0 + apart}) {
    ProbeSpec probe;
    probe.name = fmt::format("x{}", x);
    probe.kind = ProbeKind::surface_height;
    probe.position = {x, 0.5, 0};
    s.probes.push_back(probe);
  }
  const auto sim = make_simulation(s, Communicator());
  std::array<Complex, 2> sum{};
  const double from = end - 3 * period;
  double last = from;
  while (sim->time() < end) {
    const double until = sim->time() < from ? from : end;
    sim->step(until);
    if (sim->time() <= from) continue;
    const Complex turn = std::exp(Complex(0, -w * sim->time())) * (sim->time() - last);
    last = sim->time();
    for (std::size_t n = 0; n < 2; ++n) sum[n] += (sim->probe(n).value - depth) * turn;
  }
  for (Complex& a : sum) a *= 2 / (end - from);
  // eta = A exp(i (w t - k x)) + B exp(i (w t + k x)), and k apart = pi / 2
  const Complex i(0, 1), one = std::exp(i * (k * 6.0));
  const Complex a = 0.5 * one * (sum[0] + i * sum[1]), b = 0.5 / one * (sum[0] - i * sum[1]);
  return {2 * std::abs(a), std::abs(b) / std::abs(a)};
}

}  // namespace

// Measured at kh = 1, 2, 3: see docs/waves.md. Theory has waves of small height; the beach is one wave long at kh = 1.
TEST_CASE("a piston makes waves of the height of theory, and a beach returns under a twentieth of them", "[long]") {
  for (const double kh : {1.0, 2.0, 3.0}) {
    const double period = 2 * M_PI / std::sqrt(g * kh / depth * std::tanh(kh));
    const Waves waves = measure(tank(period, 6), period, 30);
    CAPTURE(kh, waves.height, waves.reflected);
    CHECK(waves.reflected <= 0.05);
    CHECK(waves.height == Approx(height).epsilon(0.05));  // 16 cells a metre: 13 a third of a wave at kh = 3
  }
}

// The measurement itself: without a beach a wave comes back whole, once it has had the time.
TEST_CASE("a tank without a beach returns its waves", "[long]") {
  const double period = 2 * M_PI / std::sqrt(g * 2 * std::tanh(2.0));
  CHECK(measure(tank(period, 0), period, 33).reflected > 0.5);
}

}  // namespace wave_tank_tests
