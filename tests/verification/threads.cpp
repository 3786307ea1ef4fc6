// Moving threads and sheets of liquid a few cells thick neither widen nor shrink.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace threads_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

// Liquid moves across a periodic box. Returns the volume that the volume control had to restore, over the liquid's
// volume.
double put_back(int dim, int cells, const std::string& phi, const VectorFormula& velocity) {
  constexpr double end = 0.5;
  Scene s = box_scene(dim, cells);
  make_periodic(s);
  add_liquid(s, phi);
  s.liquid.velocity = velocity;
  s.time.end = end;
  s.time.max_step = 0.35 / cells;
  const auto sim = make_simulation(s, Communicator());
  const double volume = sim->stats().liquid_volume;
  while (sim->time() < end) sim->step(end);
  const StepStats stats = sim->stats();
  CHECK(stats.liquid_volume / volume == Approx(1).epsilon(1e-3));
  return stats.volume_corrected / volume;
}

// A sheet normal to an axis, and one at 45 degrees through all corners of the box.
double flat(int dim, double width) {
  const int cells = dim == 2 ? 32 : 16;
  return put_back(dim, cells, fmt::format("abs(y-0.5)-{}", 0.5 * width / cells), {"0.6", "1", dim == 2 ? "0" : "0.3"});
}
double aslant(int dim, double width) {
  const int cells = dim == 2 ? 32 : 16;
  return put_back(dim, cells, fmt::format("min(abs(x-y),1-abs(x-y))/sqrt(2)-{}", 0.5 * width / cells),
                  {"1", "-0.6", dim == 2 ? "0" : "0.3"});
}

}  // namespace

// Cubic interpolation across the middle of a thread, where phi has a kink, widened threads by 178, 61, 13 % over this
// distance of 16 cells along an axis in 2D, and by 120, 17, 1.4 % at 45 degrees. One-sided interpolation gives 0.5,
// 1.7, 1.2 % and 1.3, 2.4, 0.3 %; sheets in 3D, at half the distance, less. The rest is due to redistancing and to
// medial axes that count in part. The bars are about twice these values.
TEST_CASE("threads and sheets of liquid fly on about as thick as they are", "[long]") {
  const std::pair<double, double> bars[] = {{2, 0.03}, {3, 0.05}, {4, 0.025}};  // width in cells; bar
  std::string text;
  for (const int dim : {2, 3})
    for (const auto& [width, bar] : bars) {
      const double straight = flat(dim, width), oblique = aslant(dim, width);
      text +=
          fmt::format("{}D, {} cells: {:.2g} put back, aslant {:.2g}, bar {}\n", dim, width, straight, oblique, bar);
      CHECK(std::abs(straight) < bar);
      CHECK(std::abs(oblique) < bar);
    }
  WARN(text);
}

}  // namespace threads_tests
