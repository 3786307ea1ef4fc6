#include "base/expression.h"

#include <muParser.h>

#include "base/curves.h"
#include "base/error.h"
#include "base/expression_names.h"
#include "base/expression_terms.h"
#include "base/signals.h"

namespace seiche {
namespace {

// Reports faulty names first, since the parser's own messages for them ("unexpected parenthesis") do not help.
std::string describe_fault(const Formula& text, const std::string& parser_message) {
  return "expression '" + text + "': " + fault_of_names(text).value_or(parser_message);
}

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [name, entry] : map) keys.push_back(name);
  return keys;
}

double value_of_curve(void* curve, double t) {
  return (*static_cast<const TimeCurve*>(curve))(t);
}

void define_constants(mu::Parser& parser) {
  parser.DefineConst("pi", 3.14159265358979323846);
}

}  // namespace

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
    define_constants(p);
    for (const auto& [name, value] : declared_signals()) p.DefineVar(name, signal_slot(name));
    for (const auto& [name, curve] : declared_curves())
      p.DefineFunUserData(name, value_of_curve, const_cast<TimeCurve*>(curve));
    p.SetExpr(text);
    impl_->constant = p.GetUsedVar().empty();
    impl_->value = p.Eval();
  } catch (const mu::Parser::exception_type& e) {
    throw Error(ExitCode::bad_input, describe_fault(text, e.GetMsg()));
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

std::vector<std::string> parser_functions() {
  return keys_of(mu::Parser().GetFunDef());
}

std::vector<std::string> parser_constants() {
  mu::Parser parser;
  define_constants(parser);
  return keys_of(parser.GetConst());
}

}  // namespace seiche
