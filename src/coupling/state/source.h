#pragma once
// A region that a source keeps filled with liquid for a time, or a drain empty, or in which one of them feeds a flow.
#include <memory>

#include "base/expression.h"
#include "base/fluid_spec.h"
#include "coupling/geometry/placed_solid.h"
#include "geometry/shapes/shapes.h"

namespace seiche {

// A value: copies share what does not change, and are placed one by one.
template <int Dim>
struct Source {
  LiquidSourceSpec spec;
  std::string name;  // "liquid.source.0"
  double sign;       // 1: adds liquid, -1: takes it away
  std::shared_ptr<const ShapeField<Dim>> shape;
  std::shared_ptr<const VectorExpression> flow;  // of the liquid that is added, m/s
  std::shared_ptr<const Expression> rate = {};   // m^Dim/s; null: none

  Source(const LiquidSourceSpec& from, const std::string& path, double way,
         std::shared_ptr<const ShapeField<Dim>> region)
      : spec(from),
        name(path),
        sign(way),
        shape(std::move(region)),
        flow(std::make_shared<const VectorExpression>(from.velocity)) {
    if (from.rate) rate = std::make_shared<const Expression>(*from.rate);
  }

  // Distance from the region, m.
  double distance(const Vec<Dim>& x) const { return (*shape)(x); }
  // Velocity of the liquid that is added at x, m/s.
  Vec3 velocity(const Vec3& x, double t) const { return (*flow)(x, t); }
  // True if that is the same everywhere.
  bool is_uniform() const { return flow->is_constant(); }
};

}  // namespace seiche
