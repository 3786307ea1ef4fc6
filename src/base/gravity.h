#pragma once
// Gravity as a function of time.
#include "base/expression.h"
#include "base/gravity_spec.h"

namespace seiche {

class Gravity {
 public:
  // Throws Error(bad_input) if a formula is not valid.
  explicit Gravity(const GravitySpec& spec) : spec_(spec), value_(spec.formula) {}

  // m/s^2, at time t.
  Vec3 at(double t) const { return value_({0, 0, 0}, t); }
  // Gravity of the step of dt that ends at `end`: its value at the middle. Liquid and bodies use the same one.
  Vec3 of_step(double end, double dt) const;
  // True unless it is zero for good. A formula counts, whatever its values: no end of time may change the answer.
  bool may_act() const { return !value_.is_constant() || at(0).norm() > 0; }
  // The largest finite |g| (m/s^2) among 1001 equally spaced samples of [from, to].
  double largest(double from, double to) const;
  // Message that names the component that is not finite at t; empty if all are finite.
  std::string fault(double t) const;

 private:
  GravitySpec spec_;
  VectorExpression value_;
};

}  // namespace seiche
