#include "scene/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/error.h"

namespace seiche {
namespace {

bool is_index(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= path.size() && !path.empty();) {
    const std::size_t dot = std::min(path.find('.', at), path.size());
    parts.push_back(path.substr(at, dot - at));
    at = dot + 1;
  }
  return parts;
}

const TomlNode* child(const TomlNode& node, const std::string& part) {
  if (node.kind == TomlNode::Kind::array) {
    const bool within = is_index(part) && part.size() < 9 && std::stoul(part) < node.items.size();
    return within ? &node.items[std::stoul(part)] : nullptr;
  }
  const TomlEntry* entry = node.find(part);
  return entry ? &entry->value : nullptr;
}

}  // namespace

std::string SceneContext::where(int line) const {
  if (line < 0) return "--set " + override_paths.at(std::size_t(-line - 1));
  const int file = line / lines_a_file, own = line % lines_a_file;
  const std::string& name = file > 0 ? included.at(std::size_t(file) - 1) : name_;
  return own == 0 ? name : fmt::format("{}:{}", name, own);
}

void SceneContext::report(const std::string& path, int line, const std::string& text) {
  constexpr std::size_t most_kept = 1000;
  ++count_;
  if (problems_.size() < most_kept) problems_.push_back({path, text, line});
}

bool SceneContext::clean(const std::string& path) const {
  return std::none_of(problems_.begin(), problems_.end(), [&](const Problem& p) {
    return p.path.compare(0, path.size(), path) == 0 && (p.path.size() == path.size() || p.path[path.size()] == '.');
  });
}

void SceneContext::throw_problems() const {
  constexpr std::size_t most = 100;
  if (problems_.empty()) return;
  std::vector<Problem> sorted = problems_;
  const auto rank = [](const Problem& p) { return std::pair(p.line < 0, std::abs(p.line)); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](auto& a, auto& b) { return rank(a) < rank(b); });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) {
    text += fmt::format("{}{}: {}", i ? "\n" : "", where(sorted[i].line), sorted[i].text);
  }
  if (count_ > most) text += fmt::format("\n{}: and {} more", name_, count_ - most);
  throw Error(ExitCode::bad_input, text);
}

std::string join_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + '.' + key;
}

std::string section_title(const std::string& path) {
  if (path.empty()) return "the scene";
  const std::vector<std::string> parts = split_path(path);
  std::string title;
  for (const std::string& part : parts) {
    if (!is_index(part)) title += (title.empty() ? "" : ".") + part;
  }
  return is_index(parts.back()) ? "[[" + title + "]]" : "[" + title + "]";
}

int line_of(const TomlNode& root, const std::string& path) {
  const TomlNode* node = &root;
  int line = 0;
  for (const std::string& part : split_path(path)) {
    node = child(*node, part);
    if (!node) break;
    line = node->line;
  }
  return line;
}

}  // namespace seiche
