#pragma once
// What a scene file says, as plain data in SI units. Scene vectors always have three components; in 2D the third is
// zero. Filled by src/scene/reader, which has checked every value; the other layers read it.
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/solid_kind.h"
#include "base/vec.h"

namespace seiche {

// A number or a formula in x, y, z, t, as text for base/expression.h ("0.5", "6*y*(1-y)").
using Formula = std::string;
using VectorFormula = std::array<Formula, 3>;

struct RotationSpec {
  Vec3 axis{0, 0, 1};
  double degrees = 0;
};

// x -> translate + R (scale x): scale first, then rotate about the origin, then translate.
struct TransformSpec {
  double scale = 1;
  RotationSpec rotate;
  Vec3 translate{0, 0, 0};
};

struct ShapeSpec {
  std::string kind;  // a name of the table in geometry/shapes/shapes.h
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};
  Vec3 center{0, 0, 0};
  Vec3 from{0, 0, 0}, to{0, 0, 0};
  Vec3 point{0, 0, 0}, normal{0, 1, 0};
  double radius = 0;
  std::filesystem::path file;  // resolved against the scene's folder
  Formula phi;                 // negative inside
  bool invert = false;
  TransformSpec transform;
  std::string where;  // "scene.toml:14" for messages
};

enum class SideType { free_slip, no_slip, periodic, inflow, outflow, moving_wall };

struct SideSpec {
  SideType type = SideType::free_slip;
  VectorFormula velocity{"0", "0", "0"};  // inflow, moving_wall
  Formula pressure = "0";                 // outflow, Pa
};

struct DomainSpec {
  Vec3 lower{0, 0, 0}, upper{1, 1, 1};
  double cell_size = 0;
  std::array<int, 3> cells{1, 1, 1};             // 1 along z in 2D
  std::array<std::array<SideSpec, 2>, 3> sides;  // [axis][0 = lower, 1 = upper]
};

enum class TimeScheme { first_order, second_order };

struct TimeSpec {
  double end = 1;
  double frame_rate = 24;
  double cfl = 1;
  std::optional<double> max_step, fixed_step;
  TimeScheme scheme = TimeScheme::second_order;
};

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

enum class Slip { free_slip, no_slip };

// Displacement of a kinematic solid from its rest pose: first rotate about center, then translate.
struct MotionSpec {
  VectorFormula translate{"0", "0", "0"};
  Vec3 axis{0, 0, 1}, center{0, 0, 0};
  Formula degrees = "0";
};

// Inertia and initial motion of a rigid solid.
struct RigidSpec {
  double density = 0;  // kg/m^3
  Vec3 velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  std::array<bool, 3> fixed_position{false, false, false}, fixed_rotation{false, false, false};  // world axes
};

// A region of an elastic solid at rest whose nodes move as prescribed.
struct PinSpec {
  ShapeSpec shape;
  MotionSpec motion;
};

// A force on part of an elastic solid's boundary: on the sides of elements whose nodes all lie in a shape at rest.
struct TractionSpec {
  ShapeSpec shape;
  VectorFormula stress{"0", "0", "0"};  // Pa, per area at rest, in x, y, z at rest and t
};

// What an elastic solid is made of; its density and initial velocities are those of RigidSpec.
struct ElasticSpec {
  std::string model = "stable_neo_hookean";  // a name of the table in solid/material/material.h
  double youngs_modulus = 0;                 // Pa
  double poisson_ratio = 0;
  double damping = 0;                       // Rayleigh's beta (stiffness), s
  double mass_damping = 0;                  // Rayleigh's alpha, 1/s
  double element_size = 0;                  // m
  int element_order = 2;                    // 1: linear, 2: quadratic
  std::vector<PinSpec> pinned;              // at rest unless they have a motion
  VectorFormula body_force{"0", "0", "0"};  // N/m^3 at rest, in x, y, z at rest and t
  std::vector<TractionSpec> tractions;
};

struct SolidSpec {
  std::string name;
  SolidKind kind = SolidKind::fixed;
  ShapeSpec shape;
  Slip slip = Slip::free_slip;
  MotionSpec motion;                      // kinematic
  RigidSpec rigid;                        // rigid and elastic
  ElasticSpec elastic;                    // elastic
  std::map<std::string, double> numbers;  // of keys that this kind alone has, as its row of the table lists them
  std::optional<double> friction;       // Coulomb's coefficient; unset: that of the other solid, 0 where both are unset
  std::optional<double> contact_angle;  // degrees; unset: that of the liquid
};

enum class ProbeKind { pressure, velocity, surface_height, front, displacement };

struct ProbeSpec {
  std::string name;
  ProbeKind kind = ProbeKind::pressure;
  Vec3 position{0, 0, 0};
  std::optional<double> every;  // s; unset: each step
  std::string solid{};          // displacement: the elastic solid, of which position is a point at rest
  std::string where{};          // "scene.toml:14" for messages
};

// How viscosity is solved for: with the pressure, after it, or by what the viscosity asks for.
enum class ViscousSolve { automatic, split, coupled };

struct SolverSpec {
  double tolerance = 1e-8;
  std::string preconditioner = "auto";
  ViscousSolve viscosity = ViscousSolve::automatic;
  double rheology_tolerance = 1e-4;  // change of velocity between outer iterations, relative
  int rheology_iterations = 30;      // outer ones a step, at most
  std::string elastic = "auto";      // stiffness of elastic solids in the solve: "factor", "iterate", or by size
};

struct OutputSpec {
  std::vector<std::string> frames{"surface", "velocity"};
  std::vector<std::string> formats{"vdb"};
  int checkpoint_every = 10;  // frames
};

// The acceleration of gravity, the same everywhere, m/s^2: numbers, or formulas in t.
struct GravitySpec {
  VectorFormula formula{"0.0", "-9.81", "0.0"};

  GravitySpec() = default;
  GravitySpec(double x, double y, double z);
  template <class Derived>
  GravitySpec(const Eigen::MatrixBase<Derived>& value) : GravitySpec(value[0], value[1], value[2]) {}
};

struct Scene {
  std::string title;
  int dimension = 3;
  GravitySpec gravity;
  DomainSpec domain;
  TimeSpec time;
  LiquidSpec liquid;
  GasSpec gas;
  std::vector<SolidSpec> solids;
  std::vector<ProbeSpec> probes;
  std::string tracking = "level_set";
  SolverSpec solver;
  OutputSpec output;
};

}  // namespace seiche
