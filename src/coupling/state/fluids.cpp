#include "coupling/state/fluids.h"

#include "base/expression.h"
#include "base/scene.h"
#include "fluid/rheology/rheology.h"

namespace seiche {
namespace {

std::optional<double> constant_viscosity_of(const LiquidSpec& liquid) {
  const Expression value(liquid.viscosity);
  if (!liquid.rheology.model.empty() || !value.is_constant()) return {};
  return value(Vec3::Zero(), 0);
}

}  // namespace

Fluids::Fluids(const Scene& scene)
    : liquid(scene.liquid),
      gas(scene.gas),
      rheology(resolve_rheology(scene)),
      gravity(scene.gravity),
      constant_viscosity_(constant_viscosity_of(liquid)),
      viscous_(constant_viscosity_ != 0 || gas_viscosity() > 0) {}

}  // namespace seiche
