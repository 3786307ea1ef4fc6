// Memory of a run by the size of its grid, before anything is set up.
#include <algorithm>
#include <cmath>

#include "base/scene.h"
#include "coupling/state/memory_model.h"
#include "coupling/state/simulation.h"

namespace seiche {

// Half of the cells are taken as near liquid, all as near gas that flows.
Cost estimate_cost(const Scene& scene, int ranks) {
  const double halo = std::ceil(scene.time.cfl) + 3;
  const double ranks_an_axis = std::pow(double(ranks), 1.0 / scene.dimension);
  double cells = 1, padded = 1;
  for (int a = 0; a < scene.dimension; ++a) {
    cells *= scene.domain.cells[a];
    padded *= scene.domain.cells[a] / ranks_an_axis + 2 * halo;
  }
  const double share = scene.gas.flows() ? 1 : 0.5;
  return {std::int64_t(std::min(cells, 9e18)),
          padded * ranks * bytes_a_cell + share * cells * bytes_a_fluid_cell(scene)};
}

}  // namespace seiche
