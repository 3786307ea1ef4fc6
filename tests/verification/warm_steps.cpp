// A warm step makes its fields in memory of earlier ones.
#include <catch2/catch.hpp>

#include "grid/recycled_memory.h"
#include "scenes.h"

using namespace seiche;
using namespace seiche::test;

namespace {

Scene dam_break(int dim, int cells) {
  Scene s = box_scene(dim, cells);
  s.gravity = Vec3(0, -9.81, 0);
  add_liquid(s, "max(x-0.4,y-0.6)");
  s.time.end = 10;
  return s;
}

// Blocks that come from the system in steps [warm, warm + counted).
std::int64_t fresh_blocks(const Scene& scene, int warm, int counted) {
  const auto sim = make_simulation(scene, Communicator());
  for (int n = 0; n < warm; ++n) sim->step(scene.time.end);
  const std::int64_t before = block_counts().fresh;
  for (int n = 0; n < counted; ++n) sim->step(scene.time.end);
  return block_counts().fresh - before;
}

}  // namespace

TEST_CASE("no memory of fields comes from the system in a warm step") {
  CHECK(fresh_blocks(dam_break(2, 128), 4, 6) == 0);
  CHECK(fresh_blocks(dam_break(3, 24), 4, 6) == 0);
}

TEST_CASE("no memory of fields comes from the system in a warm step of viscous liquid with gas") {
  Scene s = dam_break(2, 128);
  s.liquid.viscosity = "0.01";
  s.gas.present = true;
  s.gas.density = 1.2;
  s.gas.viscosity = 1.8e-5;
  CHECK(fresh_blocks(s, 4, 3) == 0);
}
