#pragma once
// Formulas in x, y, z, t, parsed by muParser. Two threads must not use the same object at once.
#include <memory>
#include <string>

#include "base/formula.h"
#include "base/vec.h"

namespace seiche {

class Expression {
 public:
  explicit Expression(const Formula& text);  // throws Error(bad_input) naming the fault
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  double operator()(const Vec3& x, double t) const;
  bool is_constant() const;  // true if none of x, y, z, t and no signal occurs

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Three formulas as one vector field.
class VectorExpression {
 public:
  explicit VectorExpression(const VectorFormula& text);
  Vec3 operator()(const Vec3& x, double t) const;
  bool is_constant() const { return parts_[0].is_constant() && parts_[1].is_constant() && parts_[2].is_constant(); }
  double component(int axis, const Vec3& x, double t) const { return parts_[axis](x, t); }

 private:
  std::array<Expression, 3> parts_;
};

}  // namespace seiche
