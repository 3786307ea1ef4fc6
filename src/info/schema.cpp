#include "info/schema.h"

#include <fmt/format.h>

#include <map>

#include "files/json.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

JsonValue type_of(const char* name) {
  return JsonMembers{{"type", name}};
}

// Any number may be a text: an expression of parameters, with or without a unit.
JsonValue number_or_text() {
  return JsonMembers{{"type", JsonItems{"number", "string"}}};
}

JsonValue array_of(JsonValue items, int least, int most) {
  return JsonMembers{{"type", "array"}, {"items", std::move(items)}, {"minItems", least}, {"maxItems", most}};
}

JsonValue names(const std::vector<std::string>& choices) {
  JsonItems items;
  for (const std::string& name : choices) items.emplace_back(name);
  return JsonMembers{{"enum", items}};
}

// Schema of a value that is no table.
JsonMembers value_schema(const Option& option) {
  const auto members = [](JsonValue value) { return std::get<JsonMembers>(value.content); };
  switch (option.type) {
    case T::boolean:
      return members(type_of("boolean"));
    case T::text:
    case T::file:
      return members(type_of("string"));
    case T::choice:
      return members(names(option.choices));
    case T::choice_list:
      return {{"type", "array"}, {"items", names(option.choices)}, {"uniqueItems", true}};
    case T::names:
      return {{"type", "array"}, {"items", type_of("string")}, {"minItems", 1}, {"uniqueItems", true}};
    case T::pair:
      return members(array_of(type_of("string"), 2, 2));
    case T::interval:
      return members(array_of(number_or_text(), 2, 2));
    case T::vector:
    case T::formula_vector:
      return members(array_of(number_or_text(), 2, 3));
    case T::points:
      return {{"type", "array"}, {"items", array_of(number_or_text(), 2, 2)}, {"minItems", 3}};
    case T::axis:
      return members(array_of(number_or_text(), 3, 3));
    case T::quaternion:
      return members(array_of(number_or_text(), 4, 4));
    case T::spin:
      return {{"anyOf", JsonItems{number_or_text(), array_of(number_or_text(), 1, 3)}}};
    default:
      return members(number_or_text());
  }
}

std::string description(const Option& option) {
  std::string text = option.doc;
  if (!option.unit.empty()) text += fmt::format(" [{}]", option.unit);
  if (!option.only_for.key.empty())
    text += fmt::format("; for {} = {}", option.only_for.key, quoted_list(option.only_for.values));
  const std::string otherwise = option.fallback.empty() ? option.unset : option.fallback;
  return otherwise.empty() ? text : fmt::format("{}. If left out: {}", text, otherwise);
}

// Tables of the scene by path, "solid[].rotate".
using Tables = std::map<std::string, std::vector<Option>>;

JsonMembers table_schema(const Tables& tables, const std::string& path) {
  JsonMembers properties;
  JsonItems required;
  const auto found = tables.find(path);
  if (found == tables.end()) return {{"type", "object"}};  // of free keys, as [parameters]
  for (const Option& option : found->second) {
    if (option.availability == Availability::later) continue;
    const std::string here = path.empty() ? option.key : path + "." + option.key;
    JsonMembers schema{{"description", description(option)}};
    if (option.type == T::table_list) {
      schema.emplace_back("type", "array");
      schema.emplace_back("items", table_schema(tables, here + "[]"));
    } else {
      const JsonMembers inner = option.type == T::table ? table_schema(tables, here) : value_schema(option);
      schema.insert(schema.end(), inner.begin(), inner.end());
    }
    properties.emplace_back(option.key, std::move(schema));
    if (option.presence == Presence::required && option.only_for.key.empty()) required.emplace_back(option.key);
  }
  JsonMembers schema{{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!required.empty()) schema.emplace_back("required", std::move(required));
  return schema;
}

}  // namespace

std::string scene_schema() {
  Tables tables;
  for (const Option& option : scene_options()) {
    const std::size_t dot = option.path.rfind('.');
    tables[dot == std::string::npos ? "" : option.path.substr(0, dot)].push_back(option);
  }
  JsonMembers schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Seiche scene"}};
  const JsonMembers top = table_schema(tables, "");
  schema.insert(schema.end(), top.begin(), top.end());
  return format_json(schema);
}

}  // namespace seiche
