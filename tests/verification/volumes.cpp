// Flows that are solved for, with the liquid's share of each cell carried beside the level set (liquid.volume =
// "cells").
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "volume_scenes.h"

namespace volumes_tests {
using namespace seiche;
using test::height;
using test::kept_in_cells;

namespace {

Scene dam_break(int dim, int cells) {
  return kept_in_cells(dim, cells, dim == 2 ? "max(x-0.4,y-0.5)" : "max(x-0.4,max(y-0.5,z-0.6))");
}

double energy(const StepStats& stats) {
  return stats.kinetic_energy + stats.potential_energy;
}

}  // namespace

// The shift of the level set alone moves 2 % of the liquid by then.
TEST_CASE("a dam break that splashes up a wall keeps its volume to rounding, without a shift", "[volumes]") {
  for (const int dim : {2, 3}) {
    const auto sim = make_simulation(dam_break(dim, dim == 2 ? 48 : 16), Communicator());
    const double volume = sim->stats().liquid_volume;
    double most = 0;
    while (sim->time() < 0.8 * (1 - 1e-12)) {
      const StepStats stats = sim->step(0.8);
      most = std::max(most, energy(stats));
      REQUIRE(stats.liquid_volume == Approx(volume).epsilon(1e-11));
    }
    const StepStats end = sim->stats();
    // A short step pushes no excess out at a blow. The surface moves a little, as volumes and level set are coupled.
    CHECK(sim->step(sim->time() + 1e-7).kinetic_energy < 1.05 * end.kinetic_energy);
    WARN(dim << "D: spilled " << end.volume_spilled / volume << ", drifting " << end.volume_drifting / volume);
    CHECK(end.volume_corrected == 0);
    CHECK(end.volume_spilled < (dim == 2 ? 0.02 : 0.1) * volume);  // in 3D few cells, which jets fill in part
    // The first step gains energy: its surface moves after it. Measured at 64 x 64 cells: 1.3 %.
    CHECK(most < 1.03 * 1000 * 9.81 * 0.25 * volume);
  }
}

// Two slabs as wide as the box: the upper one falls on the lower one, and both come to rest. Their volume lies below
// 0.54 m then: energy 0.5 rho g 0.54^2 an area of 1 m^2. The level set may be off by a tenth of a cell. Without
// pressure in the closing gap 1.7 % of the liquid was handed on.
TEST_CASE("a slab that falls on another one brings a closing gap no more than it holds", "[volumes]") {
  for (const int dim : {2, 3}) {
    const int cells = dim == 2 ? 48 : 20;
    const auto sim = make_simulation(kept_in_cells(dim, cells, "min(y-0.3, max(0.46-y,y-0.7))"), Communicator());
    const double volume = sim->stats().liquid_volume;
    while (sim->time() < 0.3 * (1 - 1e-12)) sim->step(0.3);
    const StepStats end = sim->stats();
    CHECK(end.volume_spilled < 0.02 / (0.54 * cells) * volume);  // what the solve leaves: a fiftieth of a row of cells
    CHECK(end.kinetic_energy < 1e-4 * end.potential_energy);
    const double off = 1000 * 9.81 * 0.54 * 0.1 / cells;  // J/m^2
    CHECK(end.potential_energy == Approx(0.5 * 1000 * 9.81 * 0.54 * 0.54).margin(off));
  }
}

TEST_CASE("liquid at rest stays at rest with volumes in cells", "[volumes]") {
  for (const int dim : {2, 3}) {
    const auto sim = make_simulation(kept_in_cells(dim, 16, "y-0.53"), Communicator());
    for (int n = 0; n < 10; ++n) (void)sim->step(1);
    CHECK(sim->stats().max_speed < 1e-8);  // the solver's tolerance
    CHECK(sim->stats().volume_spilled < 1e-8);
  }
}

// x = x0 + v t + g t^2/2.
TEST_CASE("a ball with volumes in cells flies along a parabola", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, 24,
                            dim == 2 ? "sqrt((x-0.3)^2+(y-0.4)^2)-0.15" : "sqrt((x-0.3)^2+(y-0.4)^2+(z-0.5)^2)-0.15");
    s.liquid.velocity = {"1", "1.5", "0"};
    const auto sim = make_simulation(s, Communicator());
    const double volume = sim->stats().liquid_volume, start = height(*sim, s.domain.cell_size);
    while (sim->time() < 0.3 * (1 - 1e-12)) (void)sim->step(0.3);
    const double rise = height(*sim, s.domain.cell_size) - start;
    WARN(dim << "D: rises by " << rise << " m");
    CHECK(rise == Approx(1.5 * 0.3 - 0.5 * 9.81 * 0.09).margin(0.05 * s.domain.cell_size));
    CHECK(sim->stats().liquid_volume == Approx(volume).epsilon(1e-12));
  }
}

TEST_CASE("a dam break with volumes in cells goes on from a checkpoint with the same bits", "[volumes]") {
  const Scene s = dam_break(2, 24);
  const auto whole = make_simulation(s, Communicator()), other = make_simulation(s, Communicator());
  other->load(whole->save());
  while (whole->time() < 0.4 * (1 - 1e-12)) (void)whole->step(0.4);
  other->load(whole->save());
  for (int n = 0; n < 5; ++n) {
    const StepStats a = whole->step(1), b = other->step(1);
    CHECK(a.dt == b.dt);
    CHECK(a.kinetic_energy == b.kinetic_energy);
    CHECK(a.liquid_volume == b.liquid_volume);
    CHECK(a.volume_spilled == b.volume_spilled);
  }
  CHECK(whole->frame_field("surface").values == other->frame_field("surface").values);
}

}  // namespace volumes_tests
