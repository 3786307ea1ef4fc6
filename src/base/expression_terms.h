#pragma once
// The expression language: one table behind docs/expressions.md and the error messages.
#include <string>
#include <vector>

namespace seiche {

enum class TermKind { variable, constant, function, operation };

struct ExpressionTerm {
  TermKind kind;
  std::string name;
  std::string meaning;
  std::string example;  // without variables; empty for variables
  double value = 0;     // of the example
};

// All terms, in the order of docs/expressions.md; operators in order of decreasing precedence.
const std::vector<ExpressionTerm>& expression_terms();

// Names of the parser's functions and constants. A test checks that the table is complete.
std::vector<std::string> parser_functions();
std::vector<std::string> parser_constants();

// docs/expressions.md as text.
std::string expression_reference();

}  // namespace seiche
