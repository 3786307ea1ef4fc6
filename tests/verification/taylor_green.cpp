// Inviscid Taylor-Green vortices (Basilisk's taylor-green.c): transport and projection without walls.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace taylor_green_tests {
using namespace seiche;

namespace {

Scene vortices(int n, double carry_x, double carry_y) {
  Scene s = test::box_scene(2, n);
  test::make_periodic(s);
  test::add_liquid(s, "-1");
  s.liquid.velocity = {fmt::format("{}-cos(2*pi*x)*sin(2*pi*y)", carry_x),
                       fmt::format("{}+sin(2*pi*x)*cos(2*pi*y)", carry_y), "0"};
  s.solver.tolerance = 1e-10;  // far below the measured discretisation errors
  return s;
}

// sqrt(mean |u - u_exact|^2) over the faces of both axes.
double vector_error(const Simulation& sim, int n, double carry_x, double carry_y) {
  const FrameField v = sim.frame_field("vel");
  const double tau = 2 * 3.14159265358979323846, t = sim.time();
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float* p = &v.values[3 * (std::size_t(j) * n + i)];
      const double xf = double(i) / n - carry_x * t, xc = (i + 0.5) / n - carry_x * t;
      const double yf = double(j) / n - carry_y * t, yc = (j + 0.5) / n - carry_y * t;
      const double ex = p[0] - (carry_x - std::cos(tau * xf) * std::sin(tau * yc));
      const double ey = p[1] - (carry_y + std::sin(tau * xc) * std::cos(tau * yf));
      sum += ex * ex + ey * ey;
    }
  return std::sqrt(sum / (double(n) * n));
}

double error_at(int n, double carry_x, double carry_y, double end) {
  const auto sim = make_simulation(vortices(n, carry_x, carry_y), Communicator());
  while (sim->time() < end) (void)sim->step(end);
  return vector_error(*sim, n, carry_x, carry_y);
}

}  // namespace

TEST_CASE("resting Taylor-Green vortices keep their velocity to t = 2", "[long]") {
  const double e64 = error_at(64, 0, 0, 2), e128 = error_at(128, 0, 0, 2);
  WARN("resting Taylor-Green L2: 64^2 " << e64 << ", 128^2 " << e128);
  CHECK(e64 <= 9e-4);  // the bars of the validation page, 1.1 B
  CHECK(e128 <= 1.2e-4);
}

TEST_CASE("carried Taylor-Green vortices converge at second order", "[long]") {
  const double e64 = error_at(64, 1, 0.7, 1), e128 = error_at(128, 1, 0.7, 1);
  WARN("carried Taylor-Green L2: 64^2 " << e64 << ", 128^2 " << e128 << ", order " << test::order(e64, e128));
  CHECK(e64 <= 1.3e-3);
  CHECK(e128 <= 3.5e-4);
  CHECK(test::order(e64, e128) >= 1.8);
}

}  // namespace taylor_green_tests
