#pragma once
// Scenes built in code for the verification tests.
#include <fmt/format.h>

#include "base/communicator.h"
#include "base/scene.h"
#include "coupling/state/simulation.h"

namespace seiche::test {

// A box [0, size] of `cells` cubes along each axis, without gravity, liquid or solids.
inline Scene box_scene(int dimension, int cells, double size = 1) {
  Scene s;
  s.title = "test";
  s.dimension = dimension;
  s.gravity = Vec3::Zero();
  s.domain.cell_size = size / cells;
  s.domain.upper = Vec3::Zero();
  for (int a = 0; a < dimension; ++a) s.domain.cells[a] = cells, s.domain.upper[a] = size;
  return s;
}

inline void make_periodic(Scene& s) {
  for (int a = 0; a < s.dimension; ++a)
    for (SideSpec& side : s.domain.sides[a]) side.type = SideType::periodic;
}

// Adds liquid where phi(x) < 0.
inline void add_liquid(Scene& s, const Formula& phi) {
  LiquidRegionSpec region;
  region.shape.kind = "expression";
  region.shape.phi = phi;
  region.shape.where = "test";
  s.liquid.regions.push_back(region);
}

// Observed order: log2 of the ratio of errors on grids whose cell sizes differ by a factor of two.
inline double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

}  // namespace seiche::test
