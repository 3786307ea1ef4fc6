#pragma once
// The tables [liquid] and [gas] of a scene. Plain data in SI units.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/motion_spec.h"
#include "base/shape_spec.h"

namespace seiche {

struct LiquidRegionSpec {
  ShapeSpec shape;
  std::optional<VectorFormula> velocity;
};

// A region in which liquid is added (a source) or taken away (a drain) while from <= t < until.
struct LiquidSourceSpec {
  ShapeSpec shape;
  VectorFormula velocity{"0", "0", "0"};  // of the liquid that a source adds, m/s
  double from = 0;
  double until = std::numeric_limits<double>::infinity();
  std::optional<Formula> rate;             // m^3/s, 2D: m^2/s, in t; unset: the shape is kept full, or empty
  std::optional<std::string> attached_to;  // solid with which it moves
  std::optional<MotionSpec> motion;        // how it moves by itself
};

// A region that draws the flow to a velocity, as a beach absorbs waves: du/dt = -rate (u - velocity).
struct SpongeSpec {
  Formula rate = "0";                     // 1/s, in x, y, z, t
  VectorFormula velocity{"0", "0", "0"};  // m/s
  std::optional<std::string> side;        // of the domain, "x_upper"; unset: the rate holds everywhere
  std::optional<double> length;           // m, from that side; the rate falls off there as the square of the way
};

// Viscosity as a function of the shear rate. The table in fluid/rheology/rheology.h lists the parameters of each model.
struct RheologySpec {
  std::string model;                     // a name of that table; empty: the liquid is Newtonian
  double viscosity = 0;                  // Pa s
  double consistency = 0;                // Pa s^exponent
  double exponent = 1;                   // of the shear rate in the stress
  double yield_stress = 0;               // Pa
  double viscosity_zero = 0;             // Pa s, at rest
  double viscosity_infinity = 0;         // Pa s, limit at large shear rates
  double time = 0;                       // s
  std::optional<double> regularisation;  // shear rate below which viscosity is bounded, 1/s; unset: see fluid/rheology
};

// explicit_steps: the step size is limited by the shortest capillary waves. semi_implicit: the curvature is filtered of
// the waves that are too short for the step, which then has no such limit.
enum class TensionScheme { explicit_steps, semi_implicit };

// by_shift: the level set alone knows the liquid; one shift of it keeps the volume. in_cells: the liquid's share of
// each cell is carried as well. automatic: see Setup::tracks_volume().
enum class VolumeKeeping { automatic, in_cells, by_shift };

struct LiquidSpec {
  double density = 1000;
  double surface_tension = 0;  // N/m
  double contact_angle = 90;   // degrees, measured in the liquid, at walls and solids
  TensionScheme tension_scheme = TensionScheme::explicit_steps;
  Formula viscosity = "0.0";  // Pa s; unused if there is a rheology
  RheologySpec rheology;
  bool separates = false;  // separating walls: the pressure at walls and solids is at least 0
  VolumeKeeping volume = VolumeKeeping::automatic;
  bool spray = true;  // with volumes in cells: liquid too little for the grid flies on as drops; false: it is left out
  VectorFormula velocity{"0", "0", "0"};
  std::optional<VectorFormula> prescribed_velocity;  // at all times; no solve, only the surface moves
  std::vector<LiquidRegionSpec> regions;
  std::vector<LiquidSourceSpec> sources, drains;
  std::vector<SpongeSpec> sponges;
};

// resolved: gas flows. volume_conserving: gas has one pressure per enclosed region, which keeps that region's volume.
enum class Bubbles { resolved, volume_conserving };

// The gas beyond the liquid's surface.
struct GasSpec {
  bool present = false;  // false: vacuum of pressure 0
  Bubbles bubbles = Bubbles::resolved;
  double density = 1.2;  // kg/m^3
  double viscosity = 0;  // Pa s
  VectorFormula velocity{"0", "0", "0"};

  bool flows() const { return present && bubbles == Bubbles::resolved; }
};

}  // namespace seiche
