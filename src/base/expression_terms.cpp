#include "base/expression_terms.h"

#include <fmt/format.h>

namespace seiche {
namespace {

using K = TermKind;

const char* const introduction = R"doc(# Expressions

Many keys of a scene take a formula in quotes instead of a number, such as `velocity = ["6*y*(1-y)", "0"]`. The scene
reference names the variables that each key offers. This page lists the whole language; a test keeps it true.

- Numbers are decimal, with an exponent where wanted: `0.5`, `1e-3`. Angles are in radians.
- Names are case-sensitive. Spaces do not matter. A product needs its `*`: `2*x`, not `2x`.
- Conditions are numbers: 0 is false, all else is true. Comparisons give 1 or 0.
- A shape is placed most exactly by a distance such as `x - 0.5`, less so by a jump such as `x < 0.5 ? -1 : 1`.
- An expression has at most 4096 characters. There is no assignment, no list and no remainder `%`.
- A value that is infinite or not a number where a run needs it is an error (division by 0, `sqrt(-1)`).
)doc";

const char* const closing = R"doc(
## Examples

| formula | meaning |
|---|---|
| `"sqrt(x^2 + y^2) - 0.3"` | `phi` of a disc of radius 0.3 m about the origin |
| `"max(a, b)"`, `"min(a, b)"`, `"-a"` | intersection, union and outside of shapes `a`, `b` that are negative inside |
| `"6*y*(1-y)"` | parabolic inflow through a side from y = 0 to 1, of mean 1 m/s |
| `"0.1*sin(2*pi*t)"` | a swing of 0.1 m, once a second |
| `"min(1, t/0.5)"` | a ramp from 0 to 1 within 0.5 s |
| `"y < 0.15 ? 1.5 : 0"` | a jet along the floor, a wall above it |
)doc";

std::string section(const char* title, TermKind kind) {
  std::string text = fmt::format("\n## {}\n\n", title);
  text += kind == K::variable ? "| name | meaning |\n|---|---|\n" : "| name | meaning | example |\n|---|---|---|\n";
  for (const ExpressionTerm& term : expression_terms()) {
    if (term.kind != kind) continue;
    // Escapes bars, which would end the table's cell.
    const auto cell = [](std::string shown) {
      for (std::size_t at = 0; (at = shown.find('|', at)) != std::string::npos; at += 2) shown.insert(at, 1, '\\');
      return shown;
    };
    text += fmt::format("| `{}` | {} |", cell(term.name), cell(term.meaning));
    text += kind == K::variable ? "\n" : fmt::format(" `{}` = {:.6g} |\n", cell(term.example), term.value);
  }
  return text;
}

std::vector<ExpressionTerm> variables_and_constants() {
  return {{K::variable, "x", "first coordinate, m", "", 0},
          {K::variable, "y", "second coordinate, m", "", 0},
          {K::variable, "z", "third coordinate, m; 0 in 2D", "", 0},
          {K::variable, "t", "simulated time, s", "", 0},
          {K::constant, "pi", "3.14159265358979323846", "pi", 3.14159265358979323846},
          {K::constant, "_pi", "the same", "_pi", 3.14159265358979323846},
          {K::constant, "_e", "2.71828182845904523536, base of the natural logarithm", "_e", 2.71828182845904523536}};
}

std::vector<ExpressionTerm> algebraic_functions() {
  return {{K::function, "abs", "magnitude", "abs(-2)", 2},
          {K::function, "sign", "-1, 0 or 1", "sign(-3)", -1},
          {K::function, "rint", "nearest whole number, halves upwards", "rint(2.5)", 3},
          {K::function, "min", "smallest of its arguments", "min(3, 1, 2)", 1},
          {K::function, "max", "largest of its arguments", "max(3, 1, 2)", 3},
          {K::function, "sum", "sum of its arguments", "sum(1, 2, 3)", 6},
          {K::function, "avg", "mean of its arguments", "avg(1, 2, 6)", 3},
          {K::function, "sqrt", "square root", "sqrt(9)", 3},
          {K::function, "exp", "e to the power of x", "exp(0)", 1},
          {K::function, "ln", "natural logarithm", "ln(_e)", 1},
          {K::function, "log", "natural logarithm too", "log(_e)", 1},
          {K::function, "log10", "logarithm to base 10", "log10(1000)", 3},
          {K::function, "log2", "logarithm to base 2", "log2(8)", 3}};
}

std::vector<ExpressionTerm> functions_of_angles() {
  return {{K::function, "sin", "sine of an angle in radians", "sin(pi/2)", 1},
          {K::function, "cos", "cosine", "cos(pi)", -1},
          {K::function, "tan", "tangent", "tan(pi/4)", 1},
          {K::function, "asin", "arc sine, -pi/2 to pi/2", "asin(1)", 1.5707963267948966},
          {K::function, "acos", "arc cosine, 0 to pi", "acos(-1)", 3.141592653589793},
          {K::function, "atan", "arc tangent, -pi/2 to pi/2", "atan(1)", 0.7853981633974483},
          {K::function, "atan2", "angle of the point (second, first argument), -pi to pi", "atan2(1, -1)",
           2.356194490192345},
          {K::function, "sinh", "hyperbolic sine", "sinh(1)", 1.1752011936438014},
          {K::function, "cosh", "hyperbolic cosine", "cosh(1)", 1.5430806348152437},
          {K::function, "tanh", "hyperbolic tangent", "tanh(1)", 0.7615941559557649},
          {K::function, "asinh", "inverse of sinh", "asinh(0)", 0},
          {K::function, "acosh", "inverse of cosh", "acosh(1)", 0},
          {K::function, "atanh", "inverse of tanh", "atanh(0)", 0}};
}

std::vector<ExpressionTerm> operators() {
  return {{K::operation, "( )", "parentheses", "(1 + 2)*3", 9},
          {K::operation, "^", "power, taken from the right: 2^(3^2)", "2^3^2", 512},
          {K::operation, "-", "sign; weaker than a power: -(2^2)", "-2^2", -4},
          {K::operation, "* /", "product, quotient", "6*2/3", 4},
          {K::operation, "+ -", "sum, difference", "3 + 4 - 5", 2},
          {K::operation, "< > <= >=", "comparisons", "2 <= 3", 1},
          {K::operation, "== !=", "equal, not equal", "2 != 3", 1},
          {K::operation, "&&", "and", "1 < 2 && 2 < 1", 0},
          {K::operation, "||", "or", "1 < 2 || 2 < 1", 1},
          {K::operation, "? :", "condition ? value where true : value where false", "2 < 3 ? 10 : 20", 10}};
}

}  // namespace

const std::vector<ExpressionTerm>& expression_terms() {
  static const std::vector<ExpressionTerm> table = [] {
    std::vector<ExpressionTerm> all;
    for (const auto& part : {variables_and_constants(), algebraic_functions(), functions_of_angles(), operators()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return table;
}

std::string expression_reference() {
  return introduction + section("Variables", K::variable) + section("Constants", K::constant) +
         section("Functions", K::function) + section("Operators, strongest first", K::operation) + closing;
}

}  // namespace seiche
