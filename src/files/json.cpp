#include "files/json.h"

#include <fmt/format.h>

namespace seiche {

std::string json_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += std::string("\\") + c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", int(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string json_value(const std::string& json, const std::string& key) {
  int depth = 0;
  for (std::size_t at = 0; at < json.size(); ++at) {
    if (json[at] == '{' || json[at] == '[') ++depth;
    if (json[at] == '}' || json[at] == ']') --depth;
    if (json[at] != '"') continue;
    std::string word;
    for (++at; at < json.size() && json[at] != '"'; ++at)
      word += json[at] == '\\' && at + 1 < json.size() ? json[++at] : json[at];
    std::size_t next = json.find_first_not_of(" \t\r\n", at + 1);
    if (depth != 1 || word != key || next == std::string::npos || json[next] != ':') continue;
    next = json.find_first_not_of(" \t\r\n", next + 1);
    if (next == std::string::npos) return "";
    if (json[next] != '"') return json.substr(next, json.find_first_of(",}] \t\r\n", next) - next);
    std::string text;
    for (++next; next < json.size() && json[next] != '"'; ++next)
      text += json[next] == '\\' && next + 1 < json.size() ? json[++next] : json[next];
    return text;
  }
  return "";
}

}  // namespace seiche
