#include "base/expression.h"

#include <muParser.h>

#include "base/error.h"

namespace seiche {

struct Expression::Impl {
  mu::Parser parser;
  double x = 0, y = 0, z = 0, t = 0;
  bool constant = false;
  double value = 0;
};

Expression::Expression(const Formula& text) : impl_(std::make_unique<Impl>()) {
  try {
    mu::Parser& p = impl_->parser;
    p.DefineVar("x", &impl_->x);
    p.DefineVar("y", &impl_->y);
    p.DefineVar("z", &impl_->z);
    p.DefineVar("t", &impl_->t);
    p.DefineConst("pi", 3.14159265358979323846);
    p.SetExpr(text);
    impl_->constant = p.GetUsedVar().empty();
    impl_->value = p.Eval();
  } catch (const mu::Parser::exception_type& e) {
    throw Error(ExitCode::bad_input, "expression '" + text + "': " + e.GetMsg());
  }
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

double Expression::operator()(const Vec3& x, double t) const {
  if (impl_->constant) return impl_->value;
  impl_->x = x[0];
  impl_->y = x[1];
  impl_->z = x[2];
  impl_->t = t;
  return impl_->parser.Eval();
}

bool Expression::is_constant() const {
  return impl_->constant;
}

VectorExpression::VectorExpression(const VectorFormula& text)
    : parts_{Expression(text[0]), Expression(text[1]), Expression(text[2])} {}

Vec3 VectorExpression::operator()(const Vec3& x, double t) const {
  return {parts_[0](x, t), parts_[1](x, t), parts_[2](x, t)};
}

}  // namespace seiche
