#pragma once
// Scenes whose liquid is kept in cells (liquid.volume = "cells").
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes.h"

namespace seiche::test {

// Liquid where phi < 0 in a box that is 1 m wide, with gravity.
inline Scene kept_in_cells(int dim, int cells, const Formula& phi) {
  Scene s = box_scene(dim, cells);
  s.gravity = {0, -9.81, 0};
  s.liquid.volume = VolumeKeeping::in_cells;
  add_liquid(s, phi);
  return s;
}

// Steps to `end`; the volume must keep to rounding.
inline std::unique_ptr<Simulation> run_keeping_volume(const Scene& s, double end) {
  auto sim = make_simulation(s, Communicator());
  const double volume = sim->stats().liquid_volume;
  while (sim->time() < end * (1 - 1e-12)) REQUIRE(sim->step(end).liquid_volume == Approx(volume).epsilon(1e-11));
  return sim;
}

// Mean height of the level set's liquid, m.
inline double height(const Simulation& sim, double h) {
  const FrameField f = sim.frame_field("surface");
  double sum = 0, liquid = 0;
  std::size_t n = 0;
  for (int k = f.lower[2]; k < f.upper[2]; ++k)
    for (int j = f.lower[1]; j < f.upper[1]; ++j)
      for (int i = f.lower[0]; i < f.upper[0]; ++i, ++n) {
        const double share = std::clamp(0.5 - f.values[n] / h, 0.0, 1.0);
        sum += share * (j + 0.5) * h, liquid += share;
      }
  return sum / liquid;
}

}  // namespace seiche::test
