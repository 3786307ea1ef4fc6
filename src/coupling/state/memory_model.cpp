#include "coupling/state/memory_model.h"

#include <cstdlib>

#include "base/scene.h"

namespace seiche {

double bytes_a_fluid_cell(const Scene& scene) {
  constexpr double inviscid = 800, viscous = 3800, with_gas = 4000;
  if (scene.gas.flows()) return with_gas;
  return has_viscous_flow(scene) && scene.dimension == 3 ? viscous : inviscid;
}

bool has_viscous_flow(const Scene& scene) {
  if (!scene.liquid.rheology.model.empty() || (scene.gas.flows() && scene.gas.viscosity > 0)) return true;
  char* end = nullptr;
  const double value = std::strtod(scene.liquid.viscosity.c_str(), &end);
  return *end != '\0' || value != 0;  // a formula that is no number counts
}

}  // namespace seiche
