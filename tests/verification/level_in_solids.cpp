// Liquid on one side of a thick wall does not appear on the other side when the wall moves.
#include "coupling/transport/level_in_solids.h"
#include "base/scene.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

#include <catch2/catch.hpp>

#include "coupling/geometry/placed_solid.h"
#include "elastic_scenes.h"
#include "grid/loops.h"

using namespace seiche;
using namespace seiche::test;

namespace {

// A wall from x = 0.3 to 0.7 (eight cells) with liquid on its left. The level set within the wall lags behind: its zero
// is at x = 0.6.
template <int Dim>
void check_sides() {
  Scene scene = box_scene(Dim, 20);
  scene.solids.push_back(elastic_box("wall", {0.3, -0.2, -0.2}, {0.7, 1.2, 1.2}, 1000, {1e5, 0.4}, 0.2));
  const Setup<Dim> setup(scene, Communicator());
  const double h = scene.domain.cell_size;
  CellField<Dim> phi(setup.domain.layout);
  const auto place = [&](const IVec<Dim>& i) { return setup.domain.layout.position(i, cell_offset<Dim>())[0]; };
  for_each_index_in_order(setup.domain.layout, setup.domain.layout.padded(),
                          [&](Site c, const IVec<Dim>& i) { phi[c] = place(i) - 0.6; });
  const CellField<Dim> before = phi;
  State<Dim> state;
  state.solids = setup.solids.at_start;
  keep_sides_of_walls(setup.domain, setup.solids.geometry.measure(place_bodies(state), 0), phi);
  int wrong = 0, touched = 0;
  for_each_index_in_order(setup.domain.layout, setup.domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    wrong += (place(i) < 0.5) != (phi[c] < 0);
    touched += std::abs(place(i) - 0.5) > 0.2 - h && phi[c] != before[c];
  });
  CHECK(wrong == 0);
  CHECK(touched == 0);
}

// A tilted slab about six cells thick. Whatever phi is inside, it becomes the continuation of the plane outside.
template <int Dim>
void check_continuation() {
  Scene scene = box_scene(Dim, 24);
  SolidSpec slab;
  slab.name = "slab";
  slab.shape.kind = "expression";
  slab.shape.phi = "abs(0.8*x-0.6*y-0.1)-0.13";
  slab.shape.where = "test";
  scene.solids.push_back(slab);
  const Setup<Dim> setup(scene, Communicator());
  State<Dim> state;
  state.solids = setup.solids.at_start;
  const auto closed = closed_cells(setup.domain, setup.solids, setup.solids.geometry.measure(place_bodies(state), 0));
  CellField<Dim> phi(setup.domain.layout);
  const auto plane = [&](const IVec<Dim>& i) {
    return std::clamp(setup.domain.layout.position(i, cell_offset<Dim>())[1] - 0.47, -setup.domain.band(),
                      setup.domain.band());
  };
  for_each_index_in_order(setup.domain.layout, setup.domain.layout.padded(),
                          [&](Site c, const IVec<Dim>& i) { phi[c] = closed[c] ? 0.3 : plane(i); });
  continue_level_set(setup.domain, setup.solids, closed, phi);
  double worst = 0;
  int count = 0;
  for_each_index_in_order(setup.domain.layout, setup.domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (std::abs(plane(i)) < setup.domain.band() - 2 * setup.domain.layout.h())
      worst = std::max(worst, std::abs(phi[c] - plane(i)));
    count += closed[c];
  });
  CHECK(count > 60);
  CHECK(worst < 1e-12);
}

}  // namespace

TEST_CASE("phi is continued straight into static solids") {
  check_continuation<2>();
  check_continuation<3>();
}

TEST_CASE("what phi says within a wall is that of the nearer side") {
  check_sides<2>();
  check_sides<3>();
}

TEST_CASE("a bag of liquid that falls leaves none behind", "[elastic]") {
  Scene s = box_scene(2, 60);
  s.gravity = {0, -9.81, 0};
  add_liquid(s, "sqrt((x-0.5)^2+(y-0.65)^2)-0.25");  // to the middle of the wall
  SolidSpec bag = elastic_solid("bag", 1100, {1e5, 0.4}, 0.05);
  bag.shape.kind = "expression";
  bag.shape.phi = "abs(sqrt((x-0.5)^2+(y-0.65)^2)-0.25)-0.05";
  s.solids.push_back(bag);
  s.time.end = 0.25;  // a fall of 0.31 m, three times the wall's thickness
  const auto sim = make_simulation(s, Communicator());
  const double start = sim->stats().liquid_volume;
  double worst = 0;
  while (sim->time() < s.time.end) worst = std::max(worst, std::abs(sim->step(s.time.end).liquid_volume / start - 1));
  WARN("volume off by " << worst << ", bar 1e-3; " << sim->step_count() << " steps");
  CHECK(worst < 1e-3);  // area of a polygon on the grid; without the correction the error was 2.8e-3
}
