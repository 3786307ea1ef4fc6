// Threads and sheets of liquid a few cells thick that fly neither widen nor wane.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

using namespace seiche;
using namespace seiche::test;

namespace {

// Liquid in a periodic box flies across the grid. What the volume control had to put back, over the liquid's volume.
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

// Along an axis, and at 45 degrees, through all corners of the box.
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

// The cubic across the middle of a thread, a kink of phi, widened them by 178, 61, 13 % on this way of 16 cells along
// an axis in 2D, by 120, 17, 1.4 % aslant. One-sided by 0.5, 1.7, 1.2 % and 1.3, 2.4, 0.3 %, sheets in 3D, half as far,
// by less: what making phi a distance again moves, and kinks that count in part. The bars are about twice that.
TEST_CASE("threads and sheets of liquid fly on about as thick as they are") {
  const std::pair<double, double> bars[] = {{2, 0.03}, {3, 0.05}, {4, 0.025}};  // cells; of the volume
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
