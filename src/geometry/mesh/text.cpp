// Tokens, numbers and messages shared by the mesh readers.
#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "geometry/mesh/formats.h"

namespace seiche::mesh {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// Removes a plus sign, which std::from_chars does not accept.
std::string_view without_plus(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-';
  return plus ? token.substr(1) : token;
}

template <class Number>
std::optional<Number> to_number(std::string_view token) {
  token = without_plus(token);
  Number value{};
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || end != token.data() + token.size()) return std::nullopt;
  return value;
}

}  // namespace

void fail_at_line(const Source& source, std::size_t line, const std::string& message) {
  throw Error(ExitCode::bad_input, source.file.string() + ":" + std::to_string(line) + ": " + message);
}

void fail_at_byte(const Source& source, std::size_t byte, const std::string& message) {
  throw Error(ExitCode::bad_input, source.file.string() + ": byte " + std::to_string(byte) + ": " + message);
}

std::vector<std::string_view> parts_of_row(std::string_view row) {
  constexpr std::string_view separators = ",; \t\r\n";
  std::vector<std::string_view> parts;
  for (std::size_t n = row.find_first_not_of(separators); n != std::string_view::npos;) {
    const std::size_t end = std::min(row.find_first_of(separators, n), row.size());
    parts.push_back(row.substr(n, end - n));
    n = row.find_first_not_of(separators, end);
  }
  return parts;
}

std::optional<double> to_double(std::string_view token) {
  return to_number<double>(token);
}
std::optional<long long> to_integer(std::string_view token) {
  return to_number<long long>(token);
}

std::string_view Tokens::next() {
  while (!rest_.empty() && is_space(rest_.front())) {
    if (rest_.front() == '\n') ++line_;
    rest_.remove_prefix(1);
  }
  std::size_t n = 0;
  while (n < rest_.size() && !is_space(rest_[n])) ++n;
  const std::string_view token = rest_.substr(0, n);
  rest_.remove_prefix(n);
  return token;
}

std::string_view Tokens::rest_of_line() {
  const std::size_t end = rest_.find('\n');
  std::string_view text = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (end != std::string_view::npos) ++line_;
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

}  // namespace seiche::mesh
