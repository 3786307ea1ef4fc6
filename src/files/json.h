#pragma once
// JSON of summaries and reports: what is written, and the top level of what was written. The adapter of nlohmann-json.
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace seiche {

struct JsonValue;
using JsonItems = std::vector<JsonValue>;
using JsonMembers = std::vector<std::pair<std::string, JsonValue>>;  // written in this order

// A value to be written; null by default.
struct JsonValue {
  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, JsonItems, JsonMembers> content;

  JsonValue() = default;
  template <class Number>
  requires std::integral<Number> || std::same_as<Number, double> JsonValue(Number number) {
    using Kept = std::conditional_t<std::integral<Number> && !std::same_as<Number, bool>, std::int64_t, Number>;
    content = Kept(number);
  }
  JsonValue(const std::optional<double>& number) {
    if (number) content = *number;
  }
  JsonValue(const char* text) : content(std::string(text)) {}
  JsonValue(std::string text) : content(std::move(text)) {}
  JsonValue(JsonItems items) : content(std::move(items)) {}
  JsonValue(JsonMembers members) : content(std::move(members)) {}
};

// Text of a value, indented by two a level, with a newline at its end. Numbers read back as they were; those that are
// not finite are null. Bytes that are no UTF-8 become U+FFFD.
std::string format_json(const JsonValue& value);

// True if a text is one whole JSON object.
bool is_json_object(std::string_view text);

// Value of a top-level key: the text of a string; a number, true, false or null as JSON. Empty for lists and objects,
// without such a key, and where is_json_object() is false.
std::string json_value(std::string_view text, const std::string& key);

// The same where it is a number.
std::optional<double> json_number(std::string_view text, const std::string& key);

}  // namespace seiche
