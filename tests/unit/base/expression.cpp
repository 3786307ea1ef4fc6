#include "base/expression.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/expression_names.h"
#include "base/expression_terms.h"

namespace expression_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> names_of(TermKind kind) {
  std::vector<std::string> names;
  for (const ExpressionTerm& term : expression_terms())
    if (term.kind == kind) names.push_back(term.name);
  std::sort(names.begin(), names.end());
  return names;
}

std::string fault(const std::string& text) {
  try {
    const Expression expression(text);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.what();
  }
  FAIL(text << " was taken");
  return {};
}

}  // namespace

TEST_CASE("the table of expressions lists the parser's functions and constants, no more and no less") {
  CHECK(names_of(TermKind::function) == parser_functions());
  CHECK(names_of(TermKind::constant) == parser_constants());
}

TEST_CASE("each example of the table has the value that stands there") {
  for (const ExpressionTerm& term : expression_terms()) {
    if (term.kind == TermKind::variable) continue;
    INFO(term.name);
    const Expression expression(term.example);
    CHECK(expression.is_constant());
    CHECK(expression(Vec3::Zero(), 0) == Approx(term.value).margin(1e-15));
  }
}

TEST_CASE("variables of the table are the place and the time") {
  CHECK(names_of(TermKind::variable) == std::vector<std::string>{"t", "x", "y", "z"});
  CHECK(Expression("x + 10*y + 100*z + 1000*t")(Vec3(1, 2, 3), 4) == Approx(4321));
}

TEST_CASE("docs/expressions.md is what the table says") {
  const auto page = std::filesystem::path(__FILE__).parent_path() / "../../../docs/expressions.md";
  std::ifstream file(page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto fresh = std::filesystem::temp_directory_path() / "expressions.md";
  if (text != expression_reference()) std::ofstream(fresh) << expression_reference();
  INFO("the page as it should be: " << fresh.string());
  CHECK(text == expression_reference());
}

TEST_CASE("names that an expression does not know are told, with the nearest one") {
  CHECK_THAT(fault("sinn(x)"), Contains("expression 'sinn(x)': unknown function 'sinn'; did you mean 'sin'?"));
  CHECK_THAT(fault("1 + Sqrt(x)"), Contains("unknown function 'Sqrt'; did you mean 'sqrt'?"));
  CHECK_THAT(fault("2*PI"), Contains("unknown name 'PI'"));
  CHECK_THAT(fault("x + temperature"), Contains("unknown name 'temperature'; known: x y z t pi"));
  CHECK_THAT(fault("gobbledygook(x)"), Contains("unknown function 'gobbledygook'; known: abs"));
}

TEST_CASE("functions without arguments and products without a sign are told") {
  CHECK_THAT(fault("sin + 1"), Contains("'sin' is a function; its argument is missing: sin(...)"));
  CHECK_THAT(fault("x (1 - x)"), Contains("'x' is no function; a product is written x*(...)"));
  CHECK_THAT(fault("2x"), Contains("a product is written with *"));
  CHECK_THAT(fault("2sin(x)"), Contains("a product is written with *"));
}

TEST_CASE("exponents of numbers are no names") {
  CHECK(names_in("1e-3*x + 2.5E4").size() == 1);
  CHECK_FALSE(fault_of_names("1e-3*sin(2*pi*x)"));
  const auto names = names_in("atan2 (y, x)");
  REQUIRE(names.size() == 3);
  CHECK(names[0].called);
  CHECK(names[1].at == 7);
}

}  // namespace expression_tests
