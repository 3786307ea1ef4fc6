// Impacts do not invert or cross elements or gain energy; a strip is folded onto itself.
#include "unit/solid/soft_motions.h"

namespace soft_violent_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

template <int Dim>
void check_impact(double E, double speed, int cells, int steps) {
  auto world = ball_at_wall<Dim>(E, speed, cells);
  const double first = world.energy();
  double before = first, worst = 0, least = 1, gap = 1, most = 0;
  for (int n = 0; n < steps; ++n) {
    world.step(0.002);
    const double now = world.energy();
    worst = std::max(worst, (now - before) / first);
    least = std::min(least, least_volume_ratio(world.soft[0].body, world.soft[0].state.u));
    gap = std::min(gap, world.report.smallest_gap);
    most = std::max(most, double(world.report.newton_iterations));
    before = now;
    CHECK(world.overlaps() == 0);
  }
  WARN(Dim << "D, E " << E << " Pa, " << speed << " m/s: energy left " << before / first << ", largest gain " << worst
           << ", det F at least " << least << ", gap " << gap << " m, " << double(world.newton_iterations) / steps
           << " iterations a step, at most " << most);
  CHECK(worst < 1e-10);
  CHECK(least > 0);
  CHECK(gap < world.options.reach);
}

}  // namespace

TEST_CASE("a fast soft disc against a wall", "[soft]") {
  for (double E : {1e2, 1e3, 1e5, 1e7, 1e9}) check_impact<2>(E, 5, 4, 30);
}

TEST_CASE("a fast soft ball against a wall", "[soft][long]") {
  check_impact<3>(1e2, 0.5, 2, 20);
  for (double E : {1e4, 1e6, 1e9}) check_impact<3>(E, 5, 2, 12);
}

TEMPLATE_TEST_CASE_SIG("a soft strip folded onto itself", "[soft][long]", ((int Dim), Dim), 2, 3) {
  FoldedStrip<Dim> strip;
  int active = 0;
  for (int n = 0; n < 80; ++n) {
    strip.fold();
    active = std::max(active, strip.world.report.active);
    REQUIRE(strip.world.overlaps() == 0);
  }
  WARN(Dim << "D: " << active << " pairs, gap " << strip.world.report.smallest_gap << " m, "
           << strip.world.newton_iterations / 80. << " iterations a step");
  CHECK(active > 3);
}

}  // namespace soft_violent_tests
