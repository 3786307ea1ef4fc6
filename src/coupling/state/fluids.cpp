#include "coupling/state/fluids.h"

#include "base/expression.h"
#include "base/scene.h"
#include "fluid/rheology/rheology.h"

namespace seiche {
namespace {

bool has_viscosity(const LiquidSpec& liquid) {
  if (!liquid.rheology.model.empty()) return true;
  const Expression value(liquid.viscosity);
  return !value.is_constant() || value(Vec3::Zero(), 0) != 0;
}

}  // namespace

Fluids::Fluids(const Scene& scene)
    : liquid(scene.liquid),
      gas(scene.gas),
      rheology(resolve_rheology(scene)),
      gravity(scene.gravity),
      viscous_(has_viscosity(liquid) || (gas.flows() && gas.viscosity > 0)) {}

}  // namespace seiche
