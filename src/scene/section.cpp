#include "scene/section.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/suggest.h"

namespace seiche {
namespace {

// Value of the key that decides on the table's other keys, as written or by default; empty if unusable.
std::string decider_text(const TomlNode& table, const std::string& key, const std::vector<Option>& options) {
  const auto option = std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.key == key; });
  if (option == options.end()) return "";
  const TomlEntry* entry = table.find(key);
  if (!entry) return option->fallback.size() > 2 ? option->fallback.substr(1, option->fallback.size() - 2) : "";
  if (!is_text(entry->value)) return "";
  const std::string& text = entry->value.text;
  const bool refused =
      std::any_of(option->refused.begin(), option->refused.end(), [&](auto& r) { return r.value == text; });
  const bool known = std::find(option->choices.begin(), option->choices.end(), text) != option->choices.end();
  return refused || known ? text : "";
}

std::string plain_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Keys permitted in this table, each once.
std::vector<std::string> allowed_keys(const TomlNode& table, const std::vector<Option>& options) {
  std::vector<std::string> names;
  for (const Option& option : options) {
    const bool wanted = option.availability == Availability::present &&
                        relevance(table, option, options) != Relevance::irrelevant &&
                        std::find(names.begin(), names.end(), option.key) == names.end();
    if (wanted) names.push_back(option.key);
  }
  return names;
}

std::string unknown_text(const Place& p, const std::string& key, const std::vector<Option>& options) {
  const std::vector<std::string> allowed = allowed_keys(*p.node, options);
  const auto near = suggest(key, allowed);
  return fmt::format("unknown key '{}' in {}; {}it may have: {}", key.substr(0, 60), section_title(p.path),
                     near ? "did you mean '" + *near + "'? " : "", plain_list(allowed));
}

std::string misplaced_text(const Place& p, const std::string& key, const std::vector<Option>& options) {
  std::vector<std::string> values;
  std::string decider;
  for (const Option& option : options) {
    if (option.key != key) continue;
    decider = option.only_for.key;
    values.insert(values.end(), option.only_for.values.begin(), option.only_for.values.end());
  }
  return fmt::format("'{}' in {} is only for {} = {}; with {} = \"{}\" it may have: {}", key, section_title(p.path),
                     decider, quoted_list(values), decider, decider_text(*p.node, decider, options),
                     plain_list(allowed_keys(*p.node, options)));
}

void check_entry(SceneContext& c, const Place& p, const TomlEntry& entry, const std::vector<Option>& options) {
  bool known = false, placed = false;
  for (const Option& option : options) {
    if (option.key != entry.key) continue;
    known = true;
    placed = placed || relevance(*p.node, option, options) != Relevance::irrelevant;
  }
  if (placed) return;
  c.report(join_path(p.path, entry.key), entry.line,
           known ? misplaced_text(p, entry.key, options) : unknown_text(p, entry.key, options));
}

}  // namespace

Relevance relevance(const TomlNode& table, const Option& option, const std::vector<Option>& options) {
  const Condition& condition = option.only_for;
  if (condition.key.empty()) return Relevance::relevant;
  const std::string value = decider_text(table, condition.key, options);
  if (value.empty()) return Relevance::unknown;
  const bool listed = std::find(condition.values.begin(), condition.values.end(), value) != condition.values.end();
  return listed ? Relevance::relevant : Relevance::irrelevant;
}

void check_keys(SceneContext& c, const Place& p, const std::vector<Option>& options) {
  for (const TomlEntry& entry : p.node->entries) check_entry(c, p, entry, options);
  for (const Option& option : options) {
    const bool needed = option.presence == Presence::required && !p.node->find(option.key) &&
                        relevance(*p.node, option, options) == Relevance::relevant;
    if (!needed) continue;
    const std::string why = option.only_for.key.empty()
                                ? ""
                                : fmt::format(" with {} = \"{}\"", option.only_for.key,
                                              decider_text(*p.node, option.only_for.key, options));
    c.report(join_path(p.path, option.key), p.node->line,
             fmt::format("{} needs '{}'{}: {}", section_title(p.path), option.key, why, option.doc));
  }
}

bool check_is_table(SceneContext& c, const Place& p, const Option& option) {
  if (p.node->kind == TomlNode::Kind::table) return true;
  c.report(p, fmt::format("{} must be a table ({}), not {}", p.path, option.doc, describe(*p.node)));
  return false;
}

bool check_is_table_list(SceneContext& c, const Place& p, const Option& option) {
  if (p.node->kind != TomlNode::Kind::array) {
    c.report(p,
             fmt::format("{} must be an array of tables, written [[{}]], not {}", p.path, p.path, describe(*p.node)));
    return false;
  }
  if (p.node->items.size() > option.most) {
    c.report(p, fmt::format("{} has {} entries; at most {} are possible", p.path, p.node->items.size(), option.most));
    return false;
  }
  for (std::size_t i = 0; i < p.node->items.size(); ++i) {
    const Place one{&p.node->items[i], join_path(p.path, std::to_string(i))};
    if (!check_is_table(c, one, option)) return false;
  }
  return true;
}

bool applies_to(const Option& option, const SceneLines& lines) {
  const Condition& condition = option.only_for;
  if (condition.key.empty()) return true;
  const auto line =
      std::find_if(lines.begin(), lines.end(), [&](const SceneLine& l) { return l.key == condition.key; });
  if (line == lines.end()) return false;
  return std::any_of(condition.values.begin(), condition.values.end(),
                     [&](const std::string& value) { return line->text == quote_toml(value); });
}

std::string inline_table(const SceneLines& lines) {
  std::string text;
  for (const SceneLine& line : lines) text += (text.empty() ? "{ " : ", ") + line.key + " = " + line.text;
  return text.empty() ? "{}" : text + " }";
}

}  // namespace seiche
