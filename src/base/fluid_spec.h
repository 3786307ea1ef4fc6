#pragma once
// The tables [liquid] and [gas] of a scene. Plain data in SI units.
#include <limits>
#include <optional>
#include <vector>

#include "base/shape_spec.h"

namespace seiche {

struct LiquidRegionSpec {
  ShapeSpec shape;
  std::optional<VectorFormula> velocity;
};

struct LiquidSourceSpec {
  ShapeSpec shape;
  VectorFormula velocity{"0", "0", "0"};
  double from = 0;
  double until = std::numeric_limits<double>::infinity();
};

// Viscosity by shear rate; which of the numbers a model has, the table in fluid/rheology/rheology.h says.
struct RheologySpec {
  std::string model;                     // a name of that table; empty: the liquid is Newtonian
  double viscosity = 0;                  // Pa s
  double consistency = 0;                // Pa s^exponent
  double exponent = 1;                   // of the shear rate in the stress
  double yield_stress = 0;               // Pa
  double viscosity_zero = 0;             // Pa s, at rest
  double viscosity_infinity = 0;         // Pa s, at any large shear rate
  double time = 0;                       // s
  std::optional<double> regularisation;  // shear rate below which stiffness is bounded, 1/s; unset: see fluid/rheology
};

// What holds the surface back: its tension as it is, in steps short enough for the shortest capillary waves, or as
// waves that a step cannot follow bear it, which leaves the step free.
enum class TensionScheme { explicit_steps, semi_implicit };

struct LiquidSpec {
  double density = 1000;
  double surface_tension = 0;  // N/m
  double contact_angle = 90;   // degrees, within the liquid, where its surface meets walls and solids
  TensionScheme tension_scheme = TensionScheme::explicit_steps;
  Formula viscosity = "0.0";  // Pa s; not used where there is a rheology
  RheologySpec rheology;
  bool separates = false;  // pressure at walls and solids is held at or above zero: liquid may part from them
  VectorFormula velocity{"0", "0", "0"};
  std::optional<VectorFormula> prescribed_velocity;  // at all times: nothing is solved, the surface alone moves
  std::vector<LiquidRegionSpec> regions;
  std::vector<LiquidSourceSpec> sources;
};

// "resolved": gas flows; "volume_conserving": it has a pressure alone, one in each enclosed region, which keeps its
// volume.
enum class Bubbles { resolved, volume_conserving };

// What is beyond the liquid's surface.
struct GasSpec {
  bool present = false;  // else pressure 0
  Bubbles bubbles = Bubbles::resolved;
  double density = 1.2;  // kg/m^3
  double viscosity = 0;  // Pa s
  VectorFormula velocity{"0", "0", "0"};

  bool flows() const { return present && bubbles == Bubbles::resolved; }
};

}  // namespace seiche
