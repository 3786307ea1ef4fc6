#pragma once
// Gravity in a scene file.
#include "base/formula.h"
#include "base/vec.h"

namespace seiche {

// Uniform acceleration of gravity, m/s^2: numbers, or formulas in t.
struct GravitySpec {
  VectorFormula formula{"0.0", "-9.81", "0.0"};

  GravitySpec() = default;
  GravitySpec(double x, double y, double z);
  template <class Derived>
  GravitySpec(const Eigen::MatrixBase<Derived>& value) : GravitySpec(value[0], value[1], value[2]) {}
};

}  // namespace seiche
