#include "files/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

Json tree_of(const JsonValue& value);

Json leaf_of(const auto& value) {
  return value;
}

// Whole numbers without ".0", as of counts.
Json leaf_of(double value) {
  constexpr double exact = 9007199254740992;  // 2^53
  const bool whole = std::abs(value) < exact && std::trunc(value) == value && !(value == 0 && std::signbit(value));
  return whole ? Json(std::int64_t(value)) : Json(value);
}

Json leaf_of(const JsonItems& items) {
  Json list = Json::array();
  for (const JsonValue& item : items) list.push_back(tree_of(item));
  return list;
}

Json leaf_of(const JsonMembers& members) {
  Json object = Json::object();
  for (const auto& [name, member] : members) object[name] = tree_of(member);
  return object;
}

Json tree_of(const JsonValue& value) {
  return std::visit([](const auto& content) { return leaf_of(content); }, value.content);
}

// A top-level text, number, truth or null; nothing where the text is no object or has no such value of this name.
// Values of any depth are left out: they would be copied and written by recursion.
std::optional<Json> find(std::string_view text, const std::string& key) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object() || !object.contains(key) || object[key].is_structured()) return std::nullopt;
  return object[key];
}

std::string dump(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string format_json(const JsonValue& value) {
  return dump(tree_of(value), 2) + "\n";
}

bool is_json_object(std::string_view text) {
  return Json::parse(text, nullptr, false).is_object();
}

std::string json_value(std::string_view text, const std::string& key) {
  const auto value = find(text, key);
  if (!value) return {};
  return value->is_string() ? value->get<std::string>() : dump(*value, -1);
}

std::optional<double> json_number(std::string_view text, const std::string& key) {
  const auto value = find(text, key);
  return value && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

}  // namespace seiche
