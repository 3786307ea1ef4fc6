#pragma once
// A region that a source keeps filled with liquid for a time.
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
