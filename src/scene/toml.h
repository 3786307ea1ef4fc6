#pragma once
// TOML text as a plain tree with line numbers. The only adapter to toml++.
#include <cstdint>
#include <string>
#include <vector>

namespace seiche {

struct TomlEntry;

struct TomlNode {
  enum class Kind { table, array, text, number, integer, coded_integer, boolean, date };
  Kind kind = Kind::table;  // coded_integer: hexadecimal, octal or binary
  int line = 0;             // > 0: line of the file; < 0: minus the number of an override; 0: the file as a whole
  double number = 0;        // number and integer
  std::int64_t integer = 0;
  bool boolean = false;
  std::string text;
  std::vector<TomlEntry> entries;  // of a table, by line
  std::vector<TomlNode> items;     // of an array

  const TomlEntry* find(const std::string& key) const;
  TomlEntry* find(const std::string& key);
};

struct TomlEntry {
  std::string key;
  int line = 0;
  TomlNode value;
};

// Parses a scene text. Throws Error(bad_input) "name:line:column: ..." for text that is not TOML 1.0 or exceeds the
// limits below. The limits are checked first and bound the parser's memory and stack.
TomlNode parse_toml(const std::string& text, const std::string& name);

// Value of an override: TOML, or else a bare word or formula as text. All lines are set to `line`. Throws
// Error(bad_input) naming the path.
TomlNode parse_override_value(const std::string& value, const std::string& path, int line);

// Kind of the node and, if short, its value: `the text "abc"`.
std::string describe(const TomlNode& node);

inline constexpr std::size_t most_scene_bytes = 16 << 20;
inline constexpr int most_scene_nesting = 32;        // brackets within brackets, or dots of one key
inline constexpr int most_scene_tokens = 1'000'000;  // brackets, commas and equal signs

// Throws Error(bad_input) naming name and line if the text exceeds the limits.
void check_scene_limits(const std::string& text, const std::string& name);

}  // namespace seiche
