#pragma once
// The fluids of a scene and gravity, fixed for the run.
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
  double gas_density() const { return has_gas() ? gas.density : 0; }  // kg/m^3
  bool is_viscous() const { return viscous_; }
  bool keeps_air() const { return gas.present && gas.bubbles == Bubbles::volume_conserving; }
  bool has_prescribed_flow() const { return liquid.prescribed_velocity.has_value(); }
  bool has_surface_tension() const { return liquid.surface_tension > 0; }

 private:
  bool viscous_;
};

}  // namespace seiche
