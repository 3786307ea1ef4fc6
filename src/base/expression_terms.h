#pragma once
// The language of expressions as users may write it: one table behind docs/expressions.md and the error messages.
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

// All terms, in the order of the page; operations by falling precedence.
const std::vector<ExpressionTerm>& expression_terms();

// Names of the functions that the parser takes, and of its constants: what the table has to hold.
std::vector<std::string> parser_functions();
std::vector<std::string> parser_constants();

// docs/expressions.md as text.
std::string expression_reference();

}  // namespace seiche
