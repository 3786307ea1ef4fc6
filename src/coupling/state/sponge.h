#pragma once
// A region that draws the flow to a velocity.
#include <optional>

#include "base/expression.h"
#include "base/fluid_spec.h"

namespace seiche {

struct Sponge {
  SpongeSpec spec;
  Expression rate;
  VectorExpression velocity;
  int axis = -1;                        // of the side; -1: no side
  double inner = 0;                     // place along the axis where the rate is 0, m
  double outer = 0;                     // of the side, m
  std::optional<double> steady_rate{};  // set if no variable occurs: formulas cost a hundred times a number
  std::optional<Vec3> steady_velocity{};

  // 1/s at x and t.
  double rate_at(const Vec3& x, double t) const {
    const double way = axis < 0 ? 1 : (x[axis] - inner) / (outer - inner);
    if (way <= 0) return 0;
    return way * way * (steady_rate ? *steady_rate : rate(x, t));
  }
  double velocity_at(int a, const Vec3& x, double t) const {
    return steady_velocity ? (*steady_velocity)[a] : velocity.component(a, x, t);
  }
};

}  // namespace seiche
