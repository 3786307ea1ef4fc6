// More touching rigid bodies than the model of their added mass covers.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace rigid_many_tests {
using namespace seiche;

TEST_CASE("a hundred and twenty discs that touch under water take their steps without overlaps", "[long]") {
  Scene s = test::box_scene(2, 48);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.9);
  constexpr double r = 0.035;
  for (int n = 0; n < 120; ++n) {
    const double x = 0.06 + 0.076 * (n % 12) + (n / 12 % 2) * 0.02, y = 0.037 + 0.073 * (n / 12);
    s.solids.push_back(test::rigid_ball("disc" + std::to_string(n), r, {x, y, 0}, n % 2 == 0 ? 300 : 2000));
  }
  s.time.fixed_step = 0.005;
  const auto sim = make_simulation(s, Communicator());
  int contacts = 0;
  for (int n = 0; n < 16; ++n) {
    const StepStats stats = sim->step(sim->time() + 0.005);
    contacts = std::max(contacts, int(stats.contacts));
    CHECK(stats.rejected == 0);
    CHECK(stats.max_divergence <= 1e-4);
  }
  WARN(contacts << " contacts");
  CHECK(contacts > 10);
  const auto discs = sim->solids();
  for (std::size_t a = 0; a < discs.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      // Contact surfaces of discs are polygons of at least 16 sides inside the circles.
      CHECK((discs[a].position - discs[b].position).norm() > 2 * r * std::cos(test::pi / 16));
}

}  // namespace rigid_many_tests
