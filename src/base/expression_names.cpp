#include "base/expression_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/curves.h"
#include "base/expression_terms.h"
#include "base/signals.h"
#include "base/suggest.h"

namespace seiche {
namespace {

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) || c == '.';
}

// The end of the number that starts at `at`, its exponent included.
std::size_t skip_number(const std::string& text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  if (at >= text.size() || (text[at] != 'e' && text[at] != 'E')) return at;
  std::size_t digits = at + 1;
  if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
  if (digits >= text.size() || !is_digit(text[digits])) return at;
  while (digits < text.size() && is_digit(text[digits])) ++digits;
  return digits;
}

bool is_called(const std::string& text, std::size_t end) {
  const std::size_t next = text.find_first_not_of(" \t\r\n", end);
  return next != std::string::npos && text[next] == '(';
}

std::vector<std::string> names_of(bool (*wanted)(TermKind)) {
  std::vector<std::string> names;
  for (const ExpressionTerm& term : expression_terms())
    if (wanted(term.kind)) names.push_back(term.name);
  return names;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string unknown(const char* what, const std::string& name, const std::vector<std::string>& known) {
  const auto near = suggest(name, known);
  return fmt::format("unknown {} '{}'; {}", what, name,
                     near ? fmt::format("did you mean '{}'?", *near) : fmt::format("known: {}", fmt::join(known, " ")));
}

}  // namespace

std::vector<NameInText> names_in(const std::string& text) {
  std::vector<NameInText> names;
  for (std::size_t at = 0; at < text.size();) {
    if (is_digit(text[at])) {
      at = skip_number(text, at);
    } else if (is_letter(text[at])) {
      std::size_t end = at;
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
      names.push_back({text.substr(at, end - at), at, is_called(text, end)});
      at = end;
    } else {
      ++at;
    }
  }
  return names;
}

std::optional<std::string> fault_of_names(const std::string& text) {
  auto functions = names_of([](TermKind kind) { return kind == TermKind::function; });
  for (const auto& [name, curve] : declared_curves()) functions.push_back(name);
  auto values = names_of([](TermKind kind) { return kind == TermKind::variable || kind == TermKind::constant; });
  for (const auto& [name, value] : declared_signals()) values.push_back(name);
  for (const NameInText& found : names_in(text)) {
    const std::string& name = found.name;
    const bool is_function = holds(functions, name), is_value = holds(values, name);
    if (found.called && is_value) return fmt::format("'{0}' is no function; a product is written {0}*(...)", name);
    if (found.called && !is_function) return unknown("function", name, functions);
    if (!found.called && is_function)
      return fmt::format("'{0}' is a function; its argument is missing: {0}(...)", name);
    if (!found.called && !is_value) return unknown("name", name, values);
    const bool glued = found.at > 0 && (is_digit(text[found.at - 1]));
    if (glued) return fmt::format("a number stands right before '{0}'; a product is written with *", name);
  }
  return std::nullopt;
}

}  // namespace seiche
