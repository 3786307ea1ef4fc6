// Initial liquid from a scene's formulas.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace initial_surface_tests {
using namespace seiche;

namespace {

double volume_of(int dim, int cells, const Formula& phi) {
  Scene s = test::box_scene(dim, cells, 2);
  test::add_liquid(s, phi);
  return make_simulation(s, Communicator())->stats().liquid_volume;
}

}  // namespace

// Liquid of depth 0.4, but 0.7 for x < 1 + y tan 30 degrees: the formula jumps along a slanted line.
TEST_CASE("liquid whose formula jumps begins with its volume") {
  const double exact = 2 * 0.4 + 0.3 + 0.57735027 * (0.49 - 0.16) / 2;
  for (const auto& [dim, cells] : {std::pair(2, 32), std::pair(2, 128), std::pair(3, 32)}) {
    const double depth = dim == 3 ? 2 : 1;
    const double error =
        volume_of(dim, cells, "y-0.4-0.3*max(0,min(1,-1000*(x-1-0.57735027*y)))") / (depth * exact) - 1;
    WARN(dim << "D, " << cells << " cells: " << 100 * error << " %");
    CHECK(std::abs(error) < 2e-3 * 32 / cells);
  }
}

TEST_CASE("a smooth formula keeps its volume to second order") {
  const double exact = 3.14159265358979 * 0.36;
  const double coarse = std::abs(volume_of(2, 32, "x*x+y*y-2*x-2*y+1.64") / exact - 1),
               fine = std::abs(volume_of(2, 64, "x*x+y*y-2*x-2*y+1.64") / exact - 1);
  WARN("disc: " << coarse << ", " << fine);
  CHECK(test::order(coarse, fine) > 1.6);
}

}  // namespace initial_surface_tests
