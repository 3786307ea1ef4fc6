// Limits on scene text before parsing: bounded nesting and size, so that no input can exhaust the parser.
#include <fmt/format.h>

#include <string_view>

#include "base/error.h"
#include "scene/toml.h"

namespace seiche {
namespace {

struct Scan {
  std::string_view text;
  std::size_t at = 0;
  int line = 1, depth = 0, dots = 0, tokens = 0;
};

bool starts(const Scan& s, std::string_view what) {
  return s.text.substr(s.at, what.size()) == what;
}

void skip_comment(Scan& s) {
  while (s.at < s.text.size() && s.text[s.at] != '\n') ++s.at;
}

// Skips the string that starts here; one of a single quote ends with its line at the latest.
void skip_string(Scan& s) {
  const char quote = s.text[s.at];
  const std::string three(3, quote);
  const bool multi_line = starts(s, three);
  s.at += multi_line ? 3 : 1;
  for (; s.at < s.text.size(); ++s.at) {
    if (s.text[s.at] == '\n') {
      if (!multi_line) return;
      ++s.line;
    } else if (s.text[s.at] == '\\' && quote == '"') {
      ++s.at;
      if (s.at < s.text.size() && s.text[s.at] == '\n') ++s.line;
    } else if (s.text[s.at] == quote && (!multi_line || starts(s, three))) {
      s.at += multi_line ? 3 : 1;
      return;
    }
  }
}

void count(Scan& s, char c) {
  const bool opens = c == '[' || c == '{', closes = c == ']' || c == '}', separates = c == ',' || c == '=';
  if (opens) ++s.depth;
  if (closes && s.depth > 0) --s.depth;
  if (opens || separates) ++s.tokens;
  if (c == '.') ++s.dots;
  if (separates || c == '\n') s.dots = 0;
  if (c == '\n') ++s.line;
}

void check(const Scan& s, const std::string& name) {
  if (s.depth > most_scene_nesting || s.dots > most_scene_nesting) {
    throw Error(ExitCode::bad_input, fmt::format("{}:{}: nested more than {} deep; no key of a scene needs that", name,
                                                 s.line, most_scene_nesting));
  }
  if (s.tokens > most_scene_tokens) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}:{}: more than {} values in one scene; put large geometry into mesh or "
                            "level-set files",
                            name, s.line, most_scene_tokens));
  }
}

}  // namespace

void check_scene_limits(const std::string& text, const std::string& name) {
  if (text.size() > most_scene_bytes) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: {} bytes; a scene has at most {} (large geometry belongs in mesh or "
                            "level-set files)",
                            name, text.size(), most_scene_bytes));
  }
  Scan s{text};
  while (s.at < s.text.size()) {
    const char c = s.text[s.at];
    if (c == '#') {
      skip_comment(s);
    } else if (c == '"' || c == '\'') {
      skip_string(s);
    } else {
      count(s, c);
      check(s, name);
      ++s.at;
    }
  }
}

}  // namespace seiche
