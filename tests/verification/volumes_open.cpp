// Volumes in cells (liquid.volume = "cells") where liquid comes and goes: inflow and outflow sides, sources.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/solid_spec.h"
#include "volume_scenes.h"

namespace volumes_open_tests {
using namespace seiche;
using test::height;
using test::kept_in_cells;

namespace {

SideSpec outflow() {
  return {SideType::outflow, {"0", "0", "0"}, "0"};
}

// Steps to `end`. Each step books all of what its volume changes by (fault_of_volume), else it would fail.
StepStats run(Simulation& sim, double end) {
  while (sim.time() < end * (1 - 1e-12)) (void)sim.step(end);
  return sim.stats();
}

// Steps of h/(4 v), so that volumes lag by the same half of a step at all times.
double quarter_cell_step(const Scene& s, double v) {
  return 0.25 * s.domain.cell_size / v;
}

}  // namespace

// A jet along x from faces between y = 0.5 and 0.75, whole ones: its volume grows by v A in a second. Liquid of the age
// a has fallen by g a^2/2, the mean by g t^2/6.
TEST_CASE("volumes in cells: a jet into an empty box brings v A t and falls freely", "[volumes]") {
  constexpr double v = 2, begin = 0.0625, end = 0.1875, g = 9.81;
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 16, "1");
    const std::string hole = dim == 2 ? "y>0.5 && y<0.75" : "y>0.5 && y<0.75 && z>0.25 && z<0.75";
    s.domain.sides[0][0] = {SideType::inflow, {hole + " ? 2 : 0", "0", "0"}, "0"};
    s.domain.sides[0][1] = outflow();
    s.time.fixed_step = quarter_cell_step(s, v);
    const auto sim = make_simulation(s, Communicator());
    const double first = run(*sim, begin).liquid_volume;
    const StepStats stats = run(*sim, end);
    const double rate = v * 0.25 * (dim == 2 ? 1 : 0.5), brought = rate * end;
    WARN(dim << "D: rate off by " << (stats.liquid_volume - first) / (rate * (end - begin)) - 1 << ", spilled "
             << stats.volume_spilled / brought << ", drifting " << stats.volume_drifting / brought);
    CHECK(stats.liquid_volume - first == Approx(rate * (end - begin)).epsilon(1e-11));
    CHECK(stats.volume_corrected == 0);
    CHECK(stats.volume_spilled < 0.01 * brought);
    const double off = 0.2 * s.domain.cell_size;  // 3D: four cells across, 0.15 cells found; 0.1 with the shift
    CHECK(height(*sim, s.domain.cell_size) == Approx(0.625 - g * end * end / 6).margin(off));
  }
}

// Full cells stay full: nothing is spilled, and as much leaves as enters.
TEST_CASE("volumes in cells: a channel with a cylinder between inflow and outflow stays full", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 12, "-1");
    s.gravity = {0, 0, 0};
    s.domain.sides[0][0] = {SideType::inflow, {"1", "0", "0"}, "0"};
    s.domain.sides[0][1] = outflow();
    SolidSpec& ball = s.solids.emplace_back();
    ball.name = "ball", ball.kind = SolidKind::fixed;
    ball.shape.kind = "sphere", ball.shape.where = "test";
    ball.shape.center = {0.4, 0.5, dim == 2 ? 0 : 0.5}, ball.shape.radius = 0.17;
    const auto sim = make_simulation(s, Communicator());
    const double volume = sim->stats().liquid_volume;
    const StepStats stats = run(*sim, 1);
    WARN(dim << "D: volume off by " << stats.liquid_volume / volume - 1 << ", spilled "
             << stats.volume_spilled / volume);
    CHECK(stats.liquid_volume == Approx(volume).epsilon(1e-6));  // the solver's tolerance
    CHECK(stats.volume_spilled < 1e-5 * volume);
  }
}

// A layer on an open bottom falls as one: its volume is A (H - g t^2/2).
TEST_CASE("volumes in cells: a layer falls out of an open bottom", "[volumes]") {
  constexpr double end = 0.3, g = 9.81;
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 16, "y-0.6");
    s.domain.sides[1][0] = outflow();
    const auto sim = make_simulation(s, Communicator());
    const StepStats stats = run(*sim, end);
    WARN(dim << "D: " << stats.liquid_volume << " of " << 0.6 - 0.5 * g * end * end);
    const double off = 0.05 * s.domain.cell_size;  // a twentieth of a cell: the first step, in first order
    CHECK(stats.liquid_volume == Approx(0.6 - 0.5 * g * end * end).margin(off));
    CHECK(stats.volume_spilled < 1e-3 * stats.liquid_volume);
  }
}

// Without gravity a source with the speed v along x keeps its shape full: it brings v A in a second.
TEST_CASE("volumes in cells: a source brings v A t", "[volumes]") {
  constexpr double v = 1, begin = 0.125, end = 0.3125;
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 16, "1");
    s.gravity = {0, 0, 0};
    s.domain.sides[0][1] = outflow();
    LiquidSourceSpec& source = s.liquid.sources.emplace_back();
    source.shape.kind = "box", source.shape.where = "test";
    source.shape.lower = {0.125, 0.375, dim == 2 ? 0 : 0.375}, source.shape.upper = {0.25, 0.625, dim == 2 ? 0 : 0.625};
    source.velocity[0] = "1";
    s.time.fixed_step = quarter_cell_step(s, v);
    const auto sim = make_simulation(s, Communicator());
    const double first = run(*sim, begin).liquid_volume;
    const StepStats stats = run(*sim, end);
    const double expected = (dim == 2 ? 0.25 : 0.0625) * v * (end - begin);
    WARN(dim << "D: rate off by " << (stats.liquid_volume - first) / expected - 1 << ", spilled "
             << stats.volume_spilled / stats.liquid_volume);
    CHECK(stats.liquid_volume - first == Approx(expected).epsilon(1e-3));  // the sudden start leaves some velocity
    CHECK(stats.volume_spilled < 1e-3 * stats.liquid_volume);
  }
}

}  // namespace volumes_open_tests
