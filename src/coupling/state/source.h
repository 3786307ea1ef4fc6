#pragma once
// A region that fills with liquid for a while.
#include <memory>

#include "base/expression.h"
#include "base/fluid_spec.h"
#include "geometry/shapes/shapes.h"

namespace seiche {

template <int Dim>
struct Source {
  LiquidSourceSpec spec;
  std::unique_ptr<ShapeField<Dim>> shape;
  VectorExpression velocity;
};

}  // namespace seiche
