// A program of another project: builds a scene with a 2D column of water in code, advances it by three steps and prints
// the result. Exit code 1 if the volume is not that of the column.
#include <base/communicator.h>
#include <base/scene.h>
#include <coupling/state/simulation.h>

#include <cmath>
#include <cstdio>

#include "base/scene.h"

namespace {

constexpr double width = 0.5, height = 0.5;

seiche::Scene water_column() {
  seiche::Scene scene;
  scene.title = "Water column";
  scene.dimension = 2;
  scene.domain.upper = {1, 1, 0};
  scene.domain.cell_size = 1.0 / 32;
  scene.domain.cells = {32, 32, 1};
  scene.time.end = 1;
  seiche::LiquidRegionSpec column;
  column.shape.kind = "box";
  column.shape.upper = {width, height, 0};
  scene.liquid.regions.push_back(column);
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const seiche::MpiSession mpi(argc, argv);
  const seiche::Scene scene = water_column();
  const auto simulation = seiche::make_simulation(scene, seiche::Communicator());
  seiche::StepStats stats;
  for (int n = 0; n < 3; ++n) stats = simulation->step(scene.time.end);
  std::printf("t = %.4f s, volume = %.6f m^2, fastest %.3f m/s\n", stats.time, stats.liquid_volume, stats.max_speed);
  // The coarse column may lose at most a percent in three steps, and must have begun to fall.
  const bool kept = std::abs(stats.liquid_volume - width * height) < 0.01 * width * height;
  return kept && stats.max_speed > 0 && simulation->step_count() == 3 ? 0 : 1;
}
