// Uses the shared library of toml++; header-only it would take seconds to compile.
#define TOML_HEADER_ONLY 0
#define TOML_SHARED_LIB 1
#include <toml++/toml.h>

#include "scene/toml.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace seiche {
namespace {

using Kind = TomlNode::Kind;

int line_of(const toml::source_region& region) {
  return int(region.begin.line);
}

TomlNode convert(const toml::node& from);

void convert_table(const toml::table& from, TomlNode& to) {
  for (auto&& [key, value] : from) {
    to.entries.push_back({std::string(key.str()), line_of(key.source()), convert(value)});
    TomlEntry& entry = to.entries.back();
    if (entry.line == 0) entry.line = entry.value.line;
    if (entry.value.line == 0) entry.value.line = entry.line;
  }
  std::stable_sort(to.entries.begin(), to.entries.end(),
                   [](const TomlEntry& a, const TomlEntry& b) { return a.line < b.line; });
}

void convert_integer(const toml::value<std::int64_t>& from, TomlNode& to) {
  using toml::value_flags;
  const auto coded = value_flags::format_as_binary | value_flags::format_as_octal | value_flags::format_as_hexadecimal;
  to.kind = (from.flags() & coded) == value_flags::none ? Kind::integer : Kind::coded_integer;
  to.integer = from.get();
  to.number = double(from.get());
}

TomlNode convert(const toml::node& from) {
  TomlNode to;
  to.line = line_of(from.source());
  if (const auto* table = from.as_table()) {
    convert_table(*table, to);
  } else if (const auto* array = from.as_array()) {
    to.kind = Kind::array;
    for (auto&& item : *array) to.items.push_back(convert(item));
  } else if (const auto* text = from.as_string()) {
    to.kind = Kind::text;
    to.text = text->get();
  } else if (const auto* integer = from.as_integer()) {
    convert_integer(*integer, to);
  } else if (const auto* number = from.as_floating_point()) {
    to.kind = Kind::number;
    to.number = number->get();
  } else if (const auto* boolean = from.as_boolean()) {
    to.kind = Kind::boolean;
    to.boolean = boolean->get();
  } else {
    to.kind = Kind::date;
  }
  return to;
}

void set_lines(TomlNode& node, int line) {
  node.line = line;
  for (TomlEntry& entry : node.entries) {
    entry.line = line;
    set_lines(entry.value, line);
  }
  for (TomlNode& item : node.items) set_lines(item, line);
}

bool may_be_bare(const std::string& value) {
  const bool quoted_or_bracketed = !value.empty() && std::string("[{\"'").find(value[0]) != std::string::npos;
  return !value.empty() && !quoted_or_bracketed && value.find_first_of("\r\n") == std::string::npos;
}

}  // namespace

const TomlEntry* TomlNode::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

TomlEntry* TomlNode::find(const std::string& key) {
  return const_cast<TomlEntry*>(std::as_const(*this).find(key));
}

TomlNode parse_toml(const std::string& text, const std::string& name) {
  check_scene_limits(text, name);
  try {
    TomlNode root = convert(toml::parse(std::string_view(text)));
    root.line = 0;
    return root;
  } catch (const toml::parse_error& e) {
    const toml::source_position at = e.source().begin;
    throw Error(ExitCode::bad_input,
                fmt::format("{}:{}:{}: not valid TOML: {}", name, at.line, at.column, e.description()));
  }
}

TomlNode parse_override_value(const std::string& value, const std::string& path, int line) {
  const std::string text = "value = " + value;
  check_scene_limits(text, "--set " + path);
  TomlNode node;
  try {
    const toml::table parsed = toml::parse(std::string_view(text));
    if (parsed.size() != 1) throw Error(ExitCode::bad_input, "--set " + path + ": give one value, on one line");
    node = convert(*parsed.get("value"));
  } catch (const toml::parse_error& e) {
    if (!may_be_bare(value)) {
      throw Error(ExitCode::bad_input,
                  fmt::format("--set {}: '{}' is not a TOML value: {}", path, value, e.description()));
    }
    node.kind = Kind::text;
    node.text = value;
  }
  set_lines(node, line);
  return node;
}

std::string describe(const TomlNode& node) {
  constexpr std::size_t short_enough = 40;
  switch (node.kind) {
    case Kind::table:
      return "a table";
    case Kind::array:
      return fmt::format("an array of {}", node.items.size());
    case Kind::text:
      return node.text.size() > short_enough ? "a text" : "the text \"" + node.text + '"';
    case Kind::number:
    case Kind::integer:
      return fmt::format("{}", node.number);
    case Kind::coded_integer:
      return "a hexadecimal, octal or binary number";
    case Kind::boolean:
      return node.boolean ? "true" : "false";
    case Kind::date:
      return "a date or time";
  }
  return "";
}

}  // namespace seiche
