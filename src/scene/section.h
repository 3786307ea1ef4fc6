#pragma once
// Tables of keys bound to the data they fill: one row per key serves reading, writing and documentation.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"
#include "scene/values.h"

namespace seiche {

// One line of a normalised scene. Headers ("[time]", "[[solid]]") have no key.
struct SceneLine {
  std::string path, key, text;
};
using SceneLines = std::vector<SceneLine>;

template <class Spec>
struct Key {
  Option option;
  std::function<void(SceneContext&, const Place&, Spec&)> read;
  // Appends this key's lines; none if it is unset. `path`: of the table that holds the key.
  std::function<void(const Spec&, int dimension, const std::string& path, SceneLines&)> write;
  std::function<std::vector<Option>()> inner{};  // the options of a table's own keys
};

template <class Spec>
struct Section {
  std::vector<Key<Spec>> keys;
  // Checks several keys against each other; runs after all keys of a table are read.
  std::function<void(SceneContext&, const Place&, Spec&)> finish{};
};

enum class Relevance { relevant, irrelevant, unknown };

// Evaluates the option's condition in this table.
Relevance relevance(const TomlNode& table, const Option& option, const std::vector<Option>& options);
// Reports unknown and misplaced keys, and missing required ones.
void check_keys(SceneContext& context, const Place& place, const std::vector<Option>& options);
// Return false and report if the node is not a table (not an array of tables).
bool check_is_table(SceneContext& context, const Place& place, const Option& option);
bool check_is_table_list(SceneContext& context, const Place& place, const Option& option);
// Evaluates the option's condition from the lines written so far (the deciding key comes first in its table).
bool applies_to(const Option& option, const SceneLines& lines);
// Writes lines as an inline table, "{ a = 1, b = 2 }".
std::string inline_table(const SceneLines& lines);

template <class Spec>
std::vector<Option> own_options(const Section<Spec>& section) {
  std::vector<Option> options;
  for (const Key<Spec>& key : section.keys) options.push_back(key.option);
  return options;
}

// All options of a section and of the tables inside it, with their paths.
template <class Spec>
std::vector<Option> all_options(const Section<Spec>& section) {
  std::vector<Option> options;
  for (const Key<Spec>& key : section.keys) {
    options.push_back(key.option);
    options.back().path = key.option.key;
    if (!key.inner) continue;
    const std::string prefix = key.option.key + (key.option.type == OptionType::table_list ? "[]." : ".");
    for (Option& option : key.inner()) {
      option.path = prefix + option.path;
      options.push_back(option);
    }
  }
  return options;
}

template <class Spec>
void read_section(SceneContext& context, const Place& place, const Section<Spec>& section,
                  const std::vector<Option>& options, Spec& out) {
  check_keys(context, place, options);
  for (const Key<Spec>& key : section.keys) {
    const TomlEntry* entry = place.node->find(key.option.key);
    if (!entry || relevance(*place.node, key.option, options) != Relevance::relevant) continue;
    key.read(context, {&entry->value, join_path(place.path, key.option.key)}, out);
  }
  if (section.finish) section.finish(context, place, out);
}

template <class Spec>
SceneLines write_section(const Section<Spec>& section, const Spec& spec, int dimension, const std::string& path) {
  SceneLines lines;
  for (const Key<Spec>& key : section.keys) {
    if (applies_to(key.option, lines)) key.write(spec, dimension, path, lines);
  }
  return lines;
}

// A key with one value. `member`: a pointer to a member of Spec, or a function that returns a reference to it.
template <class Spec, class Member>
Key<Spec> value_key(Option option, Member member) {
  if (option.presence == Presence::optional && option.only_for.key.empty()) {
    option.fallback = to_toml(std::invoke(member, std::as_const(*std::make_unique<Spec>())), option, 3);
  }
  Key<Spec> key{option, {}, {}};
  key.read = [option, member](SceneContext& c, const Place& p, Spec& s) {
    read_value(c, p, option, std::invoke(member, s));
  };
  key.write = [option, member](const Spec& s, int dimension, const std::string& path, SceneLines& lines) {
    const std::string text = to_toml(std::invoke(member, s), option, dimension);
    if (!text.empty()) lines.push_back({join_path(path, option.key), option.key, text});
  };
  return key;
}

// A key with one of several names, each for a value of an enumeration.
template <class Spec, class Member, class Value>
Key<Spec> choice_key(Option option, Member member, const std::vector<std::pair<std::string, Value>>& names) {
  option.type = OptionType::choice;
  for (const auto& [name, value] : names) option.choices.push_back(name);
  const auto name_of = [names](Value wanted) {
    for (const auto& [name, value] : names) {
      if (value == wanted) return name;
    }
    return std::string();
  };
  if (option.presence == Presence::optional) {
    option.fallback = quote_toml(name_of(std::invoke(member, std::as_const(*std::make_unique<Spec>()))));
  }
  Key<Spec> key{option, {}, {}};
  key.read = [option, member, names](SceneContext& c, const Place& p, Spec& s) {
    std::string text;
    read_value(c, p, option, text);
    for (const auto& [name, value] : names) {
      if (name == text) std::invoke(member, s) = value;
    }
  };
  key.write = [option, member, name_of](const Spec& s, int, const std::string& path, SceneLines& lines) {
    lines.push_back({join_path(path, option.key), option.key, quote_toml(name_of(std::invoke(member, s)))});
  };
  return key;
}

// A documented key that this version does not implement; option.doc names the alternative.
template <class Spec>
Key<Spec> later_key(Option option) {
  option.availability = Availability::later;
  Key<Spec> key{option, {}, [](const Spec&, int, const std::string&, SceneLines&) {}};
  key.read = [option](SceneContext& c, const Place& p, Spec&) {
    if (option.only_for.key.empty()) c.report(p, p.path + ": " + option.doc);
  };
  return key;
}

// Turns a section's keys into keys of Spec that act on one of its members.
template <class Spec, class Inner, class Member>
std::vector<Key<Spec>> lift(const Section<Inner>& section, Member member) {
  std::vector<Key<Spec>> keys;
  for (const Key<Inner>& inner : section.keys) {
    Key<Spec> key{inner.option, {}, {}, inner.inner};
    key.read = [inner, member](SceneContext& c, const Place& p, Spec& s) { inner.read(c, p, std::invoke(member, s)); };
    key.write = [inner, member](const Spec& s, int dimension, const std::string& path, SceneLines& lines) {
      inner.write(std::invoke(member, s), dimension, path, lines);
    };
    keys.push_back(std::move(key));
  }
  return keys;
}

// A key with a table, written inline.
template <class Spec, class Member, class Inner>
Key<Spec> inline_key(Option option, Member member, const Section<Inner>& section) {
  option.type = OptionType::table;
  const std::vector<Option> options = own_options(section);
  Key<Spec> key{option, {}, {}, [section] { return all_options(section); }};
  key.read = [option, options, member, section](SceneContext& c, const Place& p, Spec& s) {
    if (check_is_table(c, p, option)) read_section(c, p, section, options, std::invoke(member, s));
  };
  key.write = [option, member, section](const Spec& s, int dimension, const std::string& path, SceneLines& lines) {
    const std::string here = join_path(path, option.key);
    lines.push_back({here, option.key, inline_table(write_section(section, std::invoke(member, s), dimension, here))});
  };
  return key;
}

// A key with a table, written inline, that may be left out.
template <class Spec, class Inner>
Key<Spec> optional_table_key(Option option, std::optional<Inner> Spec::*member, const Section<Inner>& section) {
  const auto made = [member](Spec& s) -> Inner& {
    if (!(s.*member)) (s.*member).emplace();
    return *(s.*member);
  };
  Key<Spec> key = inline_key<Spec>(
      option, [made](auto& s) -> auto& { return made(const_cast<Spec&>(s)); }, section);
  const auto write = key.write;
  key.write = [write, member](const Spec& s, int dimension, const std::string& path, SceneLines& lines) {
    if (s.*member) write(s, dimension, path, lines);
  };
  return key;
}

// A key with a table, written as a block.
template <class Spec, class Member, class Inner>
Key<Spec> block_key(Option option, Member member, const Section<Inner>& section) {
  Key<Spec> key = inline_key<Spec>(option, member, section);
  key.write = [option, member, section](const Spec& s, int dimension, const std::string& path, SceneLines& lines) {
    const std::string here = join_path(path, option.key);
    lines.push_back({here, "", section_title(here)});
    const SceneLines inner = write_section(section, std::invoke(member, s), dimension, here);
    lines.insert(lines.end(), inner.begin(), inner.end());
  };
  return key;
}

// A key with an array of tables.
template <class Spec, class Inner>
Key<Spec> list_key(Option option, std::vector<Inner> Spec::*member, const Section<Inner>& section) {
  option.type = OptionType::table_list;
  const std::vector<Option> options = own_options(section);
  Key<Spec> key{option, {}, {}, [section] { return all_options(section); }};
  key.read = [option, options, member, section](SceneContext& c, const Place& p, Spec& s) {
    if (!check_is_table_list(c, p, option)) return;
    (s.*member).resize(p.node->items.size());
    for (std::size_t i = 0; i < p.node->items.size(); ++i) {
      read_section(c, {&p.node->items[i], join_path(p.path, std::to_string(i))}, section, options, (s.*member)[i]);
    }
  };
  key.write = [option, member, section](const Spec& s, int dimension, const std::string& path, SceneLines& lines) {
    for (std::size_t i = 0; i < (s.*member).size(); ++i) {
      const std::string here = join_path(join_path(path, option.key), std::to_string(i));
      lines.push_back({here, "", section_title(here)});
      const SceneLines inner = write_section(section, (s.*member)[i], dimension, here);
      lines.insert(lines.end(), inner.begin(), inner.end());
    }
  };
  return key;
}

}  // namespace seiche
