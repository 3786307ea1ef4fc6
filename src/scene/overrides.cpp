#include "scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "base/error.h"

namespace seiche {
namespace {

[[noreturn]] void fail(const Override& override, const std::string& text) {
  throw Error(ExitCode::bad_input, "--set " + override.path + ": " + text);
}

std::vector<std::string> path_parts(const Override& override) {
  std::vector<std::string> parts(1);
  for (const char c : override.path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  const bool gap = std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return part.empty(); });
  if (gap) fail(override, "the path must look like key.path");
  if (parts.size() > std::size_t(most_scene_nesting)) fail(override, "the path is too long");
  return parts;
}

std::optional<std::size_t> index_of(const std::string& part) {
  std::size_t index = 0;
  const char* end = part.data() + part.size();
  const auto [stopped, error] = std::from_chars(part.data(), end, index);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return index;
}

TomlNode& step_into_array(TomlNode& array, const std::string& part, const std::string& walked,
                          const Override& override) {
  const auto index = index_of(part);
  if (index && *index < array.items.size()) return array.items[*index];
  const std::size_t count = array.items.size();
  fail(override, count == 0 ? fmt::format("{} has no entries", walked)
                            : fmt::format("{} has {} entries, numbered 0 to {}; there is no '{}'", walked, count,
                                          count - 1, part));
}

TomlNode& step_into(TomlNode& node, const std::string& part, const std::string& walked, const Override& override,
                    int line) {
  if (node.kind == TomlNode::Kind::array) return step_into_array(node, part, walked, override);
  if (node.kind != TomlNode::Kind::table) fail(override, fmt::format("{} is {}, not a table", walked, describe(node)));
  if (TomlEntry* entry = node.find(part)) return entry->value;
  node.entries.push_back({part, line, {}});
  node.entries.back().value.line = line;
  return node.entries.back().value;
}

}  // namespace

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(ExitCode::bad_input, "--set " + text + ": write --set key.path=value");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void apply_overrides(TomlNode& root, const std::vector<Override>& overrides) {
  for (std::size_t n = 0; n < overrides.size(); ++n) {
    const Override& override = overrides[n];
    const int line = -int(n) - 1;
    TomlNode* node = &root;
    std::string walked;
    for (const std::string& part : path_parts(override)) {
      node = &step_into(*node, part, walked, override, line);
      walked += (walked.empty() ? "" : ".") + part;
    }
    *node = parse_override_value(override.value, override.path, line);
  }
}

}  // namespace seiche
