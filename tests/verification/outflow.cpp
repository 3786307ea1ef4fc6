// Liquid that leaves through a side and returns.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace outflow_tests {
using namespace seiche;

// An eddy through the top of a full box: as much liquid enters as leaves, and the expected volume counts both.
TEST_CASE("what comes back through a full outflow side is booked") {
  for (int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 12);
    s.domain.sides[1][1].type = SideType::outflow;
    s.liquid.velocity = {"(cos(6.28318530718*x)-1)/6.28318530718", "y*sin(6.28318530718*x)", "0"};
    test::add_liquid(s, "-1");
    s.time.frame_rate = 10;
    const double end = 0.3;
    const auto sim = make_simulation(s, Communicator());
    double largest = 0, inwards = 0;
    while (sim->time() < end) {
      const StepStats stats = sim->step(end);
      largest = std::max(largest, std::abs(sim->expected_volume() / stats.liquid_volume - 1));
    }
    const FrameField u = sim->frame_field("vel");
    const int n = s.domain.cells[0], row = n - 1;
    for (int i = 0; i < n; ++i) inwards = std::max(inwards, -double(u.values[3 * std::size_t(i + n * row) + 1]));
    WARN(dim << "D: largest drift " << largest << ", inwards at the outflow " << inwards << " m/s");
    CHECK(largest < 1e-3);
    CHECK(inwards > 0.1);
  }
}

// Liquid at rest in a full box with an inflow of 1 m/s: it moves at once, and what the inflow feeds leaves. Both are
// booked in the first step, whether it is one of second order (leapfrog) or of first.
TEST_CASE("the first step books what leaves a full box as it books what enters") {
  for (int dim : {2, 3})
    for (const TimeScheme scheme : {TimeScheme::second_order, TimeScheme::first_order}) {
      Scene s = test::box_scene(dim, 12);
      s.domain.sides[0][0].type = SideType::inflow;
      s.domain.sides[0][0].velocity = {"1", "0", "0"};
      s.domain.sides[0][1].type = SideType::outflow;
      s.time.scheme = scheme;
      test::add_liquid(s, "-1");
      const auto sim = make_simulation(s, Communicator());
      const StepStats stats = sim->step(0.05);
      const double passed = sim->time();  // m^dim through a face of 1 m^(dim - 1)
      CHECK(std::abs(sim->expected_volume() - stats.liquid_volume) < 1e-6 * passed);
    }
}

}  // namespace outflow_tests
