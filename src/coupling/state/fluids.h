#pragma once
// The fluids of a scene and gravity, fixed for the run.
#include <optional>

#include "base/fluid_spec.h"
#include "base/gravity.h"

namespace seiche {

struct Scene;

struct Fluids {
  LiquidSpec liquid;
  GasSpec gas;
  RheologySpec rheology;  // of `liquid`, with its regularisation set
  Gravity gravity;

  explicit Fluids(const Scene& scene);

  double density() const { return liquid.density; }  // kg/m^3
  bool has_gas() const { return gas.flows(); }
  double gas_density() const { return has_gas() ? gas.density : 0; }      // kg/m^3
  double gas_viscosity() const { return has_gas() ? gas.viscosity : 0; }  // Pa s
  bool is_viscous() const { return viscous_; }
  // Viscosity of the liquid, Pa s, if it is the same everywhere and always; empty: by a formula or rheology.
  std::optional<double> constant_viscosity() const { return constant_viscosity_; }
  bool keeps_air() const { return gas.present && gas.bubbles == Bubbles::volume_conserving; }
  bool has_prescribed_flow() const { return liquid.prescribed_velocity.has_value(); }
  bool has_surface_tension() const { return liquid.surface_tension > 0; }
  bool has_gravity_waves() const { return gravity.may_act() && !has_surface_tension(); }  // gravity alone drives them

 private:
  std::optional<double> constant_viscosity_;
  bool viscous_;
};

}  // namespace seiche
