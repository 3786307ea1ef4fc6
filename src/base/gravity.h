#pragma once
// Gravity as it changes in time.
#include "base/expression.h"
#include "base/gravity_spec.h"

namespace seiche {

class Gravity {
 public:
  // Throws Error(bad_input) where a formula is none.
  explicit Gravity(const GravitySpec& spec) : spec_(spec), value_(spec.formula) {}

  // m/s^2, at time t.
  Vec3 at(double t) const { return value_({0, 0, 0}, t); }
  // Of the step of dt that ends at `end`: gravity at its middle, for liquid and bodies alike.
  Vec3 of_step(double end, double dt) const;
  // The largest |g| in [from, to] (m/s^2), looked at at a thousand times; what is not finite does not count.
  double largest(double from, double to) const;
  // Empty, or which formula is not finite at t.
  std::string fault(double t) const;

 private:
  GravitySpec spec_;
  VectorExpression value_;
};

}  // namespace seiche
