// Volumes in cells (liquid.volume = "cells") beside solids that move.
#include <catch2/catch.hpp>

#include "rigid_scenes.h"
#include "volume_scenes.h"

namespace volumes_moving_solids_tests {
using namespace seiche;
using test::add_pool, test::kept_in_cells, test::rigid_ball, test::rigid_box, test::run_keeping_volume;

namespace {

SolidSpec moved(SolidSpec s, const VectorFormula& by) {
  s.kind = SolidKind::kinematic;
  s.motion.translate = by;
  return s;
}

double largest_level(const Simulation& sim) {
  const FrameField f = sim.frame_field("surface");
  return *std::max_element(f.values.begin(), f.values.end());
}

}  // namespace

// A shuttle that covers and bares cells by up to 0.7 of one a step. Nothing may open behind it.
TEST_CASE("volumes beside moving solids: a full box stays full", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 12, "-1");
    s.solids = {moved(rigid_ball("shuttle", dim == 2 ? 0.12 : 0.2, {0.5, 0.5, 0.5}, 1000),
                      {"0.2*sin(3*t)", "0.1*sin(5*t)", "0"})};
    const auto sim = run_keeping_volume(s, 1);
    CHECK(largest_level(*sim) < 0);
    CHECK(sim->stats().volume_spilled < 1e-3 * sim->stats().liquid_volume);
    CHECK(sim->stats().volume_drifting == 0);
  }
}

// It bobs a little where the surface meets it, with either way to keep the volume.
TEST_CASE("volumes beside moving solids: a floating body stays as still as with the shift", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 16, "1");
    s.liquid.regions.clear();
    add_pool(s, 0.505);
    s.solids = {rigid_box("raft", {0.4, 0.26, 0.4}, {0.5, 0.505, 0.5}, 500)};
    const StepStats end = run_keeping_volume(s, 0.5)->stats();
    s.liquid.volume = VolumeKeeping::by_shift;
    const auto shift = make_simulation(s, Communicator());
    while (shift->time() < 0.5 * (1 - 1e-12)) (void)shift->step(0.5);
    WARN(dim << "D: " << end.max_speed << ", by shift " << shift->stats().max_speed << " m/s");
    CHECK(end.max_speed < 1.2 * shift->stats().max_speed + 1e-5);
    CHECK(end.volume_spilled < 1e-6 * end.liquid_volume);
  }
}

// A wall closes in on a pool from 0.8 m to 0.5 m within a second, smoothly. The pool rises as its length falls.
TEST_CASE("volumes beside moving solids: a piston lifts a pool", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 40 : 20, "1");
    s.liquid.regions.clear();
    add_pool(s, 0.4);
    s.solids = {moved(rigid_box("piston", {1, 2, 2}, {-0.3, 0.5, 0.5}, 1000), {"0.15*(1-cos(pi*t))", "0", "0"})};
    const auto sim = run_keeping_volume(s, 1);
    CHECK(sim->stats().volume_spilled < 0.005 * sim->stats().liquid_volume);
    const double rest = 0.5 * 1000 * 9.81 * std::pow(0.4 * 0.8, 2) / 0.5;  // J, potential energy
    CHECK(sim->stats().potential_energy > 0.99 * rest);
    CHECK(sim->stats().potential_energy < 1.03 * rest);  // it sloshes
  }
}

TEST_CASE("volumes beside moving solids: a dam break carries a box along", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 40 : 16, "max(x-0.3,y-0.6)");
    s.solids = {rigid_box("box", {0.2, 0.18, 0.3}, {0.6, 0.12, 0.4}, 500, 10)};
    const auto sim = run_keeping_volume(s, 0.8);
    const StepStats start = make_simulation(s, Communicator())->stats(), end = sim->stats();
    WARN(dim << "D: spilled " << end.volume_spilled / end.liquid_volume);
    CHECK(end.volume_spilled < 0.02 * end.liquid_volume);  // 0.0198, 0.011
    CHECK(end.kinetic_energy + end.potential_energy < 1.02 * (start.kinetic_energy + start.potential_energy));
  }
}

}  // namespace volumes_moving_solids_tests
