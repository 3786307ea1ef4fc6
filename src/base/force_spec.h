#pragma once
// A [[force]] of a scene: acts on liquid and solids beside gravity. Plain data in SI units.
#include <optional>
#include <string>
#include <vector>

#include "base/formula.h"
#include "base/shape_spec.h"
#include "base/vec.h"

namespace seiche {

enum class ForceKind { acceleration, point, vortex, drag, wind, load };
enum class ForceTarget { all, liquid, solids };

struct ForceSpec {
  std::string name;
  ForceKind kind = ForceKind::acceleration;
  ForceTarget acts_on = ForceTarget::all;     // load: solids
  std::vector<std::string> solids;            // names with wildcards; empty: all that forces move
  std::optional<ShapeSpec> region;            // where it acts; unset: everywhere
  VectorFormula acceleration{"0", "0", "0"};  // m/s^2, in x, y, z, t
  Vec3 center{0, 0, 0}, axis{0, 0, 1};        // point, vortex; axis of a load's torque, too
  Formula strength = "0";                     // point, vortex: m/s^2, in t
  double radius = 0;                          // of both, m
  VectorFormula velocity{"0", "0", "0"};      // drag, wind: of what drags, m/s, in x, y, z, t
  Formula rate = "0";                         // drag: 1/s, in x, y, z, t
  double air_density = 1.2;                   // wind: kg/m^3
  double drag_coefficient = 1;                // wind on solids, with the area that faces it
  double surface_drag = 0.0013;               // wind on the liquid's surface
  VectorFormula force{"0", "0", "0"};         // load: N, in t; 2D: per metre of depth
  Formula torque = "0";                       // load: N m about axis, in t; 2D: per metre of depth
  std::optional<Vec3> at;                     // load: where on the solid at t = 0, m
  bool turns_with_solid = false;              // load
  std::string where;                          // file and line
};

}  // namespace seiche
