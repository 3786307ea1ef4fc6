// Warm steps ask the system for no memory of large fields: they use again what earlier steps gave back.
#include <catch2/catch.hpp>

#include "grid/field_memory.h"
#include "scenes.h"

namespace memory_of_steps_tests {
using namespace seiche;
using namespace seiche::test;

TEST_CASE("a warm step of a dam break takes no memory for fields", "[long]") {
  constexpr int cells = 64, warm_up = 6, steps = 4;
  Scene s = box_scene(3, cells);
  s.gravity = Vec3(0, -9.81, 0);
  add_liquid(s, "max(x-0.3,y-0.6)");
  s.time.end = 1;
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < warm_up; ++n) sim->step(s.time.end);
  const std::size_t before = large_fields_mapped();
  CHECK(before > 10);
  for (int n = 0; n < steps; ++n) sim->step(s.time.end);
  const double per_step = double(large_fields_mapped() - before) / steps;
  WARN(before << " large fields mapped by the first steps, " << per_step << " by each later one");
  CHECK(per_step == 0);
}

}  // namespace memory_of_steps_tests
