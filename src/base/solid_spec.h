#pragma once
// A [[solid]] of a scene. Plain data in SI units.
#include <map>
#include <optional>
#include <vector>

#include "base/motion_spec.h"
#include "base/shape_spec.h"
#include "base/solid_kind.h"

namespace seiche {

enum class Slip { free_slip, no_slip };

// Inertia and initial motion of a rigid solid.
struct RigidSpec {
  double density = 0;                       // kg/m^3; 0: a mass is given
  std::optional<double> mass;               // kg; 2D: kg/m
  std::optional<Vec3> center_of_mass;       // at t = 0, m; unset: that of the shape
  std::optional<Vec3> inertia;              // moments about the centre of mass at t = 0, kg m^2; 2D: (2)
  std::optional<Vec3> products_of_inertia;  // I_xy, I_xz, I_yz, kg m^2
  Vec3 velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  std::array<bool, 3> fixed_position{false, false, false}, fixed_rotation{false, false, false};  // world axes
};

// A region of an elastic solid at rest whose nodes have a prescribed motion.
struct PinSpec {
  ShapeSpec shape;
  MotionSpec motion;
};

// A traction on part of an elastic solid's boundary: on the element sides whose nodes all lie in `shape` at rest.
struct TractionSpec {
  ShapeSpec shape;
  VectorFormula stress{"0", "0", "0"};  // Pa, per area at rest, in x, y, z at rest and t
};

// Material and discretisation of an elastic solid. Its density and initial velocities are those of RigidSpec.
struct ElasticSpec {
  std::string model = "stable_neo_hookean";  // a name from the table in solid/material/material.h
  double youngs_modulus = 0;                 // Pa
  double poisson_ratio = 0;
  double damping = 0;                       // Rayleigh's beta (stiffness), s
  double mass_damping = 0;                  // Rayleigh's alpha, 1/s
  double element_size = 0;                  // m
  int element_order = 2;                    // 1: linear, 2: quadratic
  std::vector<PinSpec> pinned;              // fixed unless they have a motion
  VectorFormula body_force{"0", "0", "0"};  // N/m^3 at rest, in x, y, z at rest and t
  std::vector<TractionSpec> tractions;
};

// Copies of a solid on a regular grid.
struct ArraySpec {
  Vec3 count{1, 1, 1};    // whole numbers
  Vec3 spacing{0, 0, 0};  // m, from one copy to the next
};

// Copies of a solid at random places that keep apart.
struct ScatterSpec {
  int count = 0, seed = 1;
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  // box that holds the copies, m
  std::optional<double> radius;         // of a ball that holds a copy, m; unset: that of the shape
  double gap = 0;                       // least distance of these balls, m
  bool turned = false;                  // each copy is turned at random
};

// Meshes of one topology that a solid takes on one after the other. Its shape names the file of the first.
struct SequenceSpec {
  int meshes = 0;     // files, whose names count up
  double rate = 0;    // meshes a second
  double start = 0;   // time of the first mesh, s
  bool loop = false;  // the first mesh follows the last; else the solid rests before and after
};

struct SolidSpec {
  std::string name;
  SolidKind kind = SolidKind::fixed;
  ShapeSpec shape;
  Slip slip = Slip::free_slip;
  MotionSpec motion;                      // kinematic
  SequenceSpec sequence;                  // deforming
  RigidSpec rigid;                        // rigid and elastic
  ElasticSpec elastic;                    // elastic
  std::map<std::string, double> numbers;  // values of the keys that only this kind has, listed in its table row
  std::optional<double> friction;         // Coulomb's coefficient; unset: that of the other solid, 0 if both are unset
  std::optional<double> contact_angle;    // degrees; unset: that of the liquid
  std::optional<ArraySpec> array;         // as read; expand_copies() makes solids of them
  std::optional<ScatterSpec> scatter;
};

}  // namespace seiche
