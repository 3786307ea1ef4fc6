#pragma once
// Liquid and solids of a scene at its start, in numbers. SI units; 2D: areas for volumes, masses a metre of depth.
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"

namespace seiche {

struct LiquidAtStart {
  double volume = 0, mass = 0;  // in the domain and outside of solids
  double in_solids = 0;         // volume of the regions that lies inside solids
  double fall = 0;              // mean height that it has to fall until it lies flat between the solids, m
};

// Upright equilibrium of a free body in still liquid: with the orientation of the start, apart from all others.
struct Floating {
  bool sinks = false;
  double draught = 0;  // depth of its lowest point below the surface, m; of bodies that float
};

struct SolidAtStart {
  enum class Extent { body, hole, half_space };
  std::string name, kind;
  Extent extent = Extent::body;  // what follows is of bodies only
  double volume = 0;
  double mass = 0;                      // of a free body, else 0
  Vec3 center{0, 0, 0};                 // of mass if it is free, else of the volume, m
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  // bounding box, m
  double outside = 0;                   // share of the volume outside of the domain
  std::optional<Floating> floating;     // unset where joints, pins or fixed axes decide
  double density() const { return volume > 0 ? mass / volume : 0; }
};

struct StartAccount {
  LiquidAtStart liquid;
  std::vector<SolidAtStart> solids;  // in the scene's order
  std::vector<std::string> losses;   // lines on regions of liquid that lie partly outside of the domain
  std::vector<std::string> others;   // lines on joints, volume, features switched off, meshes of elastic solids
};

}  // namespace seiche
