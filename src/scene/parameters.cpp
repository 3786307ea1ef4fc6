#include "scene/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/expression.h"
#include "base/expression_names.h"
#include "base/signals.h"
#include "scene/context.h"
#include "scene/formula.h"
#include "scene/toml.h"
#include "scene/units.h"

namespace seiche {
namespace {

// Value of an expression without variables.
std::optional<double> value_of(const std::string& text, std::string& fault) {
  const Option constant{.key = "", .type = OptionType::formula, .range = any_number()};
  if (const auto why = formula_fault(text, constant)) {
    fault = *why;
    return std::nullopt;
  }
  return Expression(text)(Vec3(0, 0, 0), 0);
}

// Parameters that the text needs and that are not known yet.
bool waits(const std::string& text, const TomlNode& table, const Parameters& known) {
  for (const NameInText& found : names_in(text))
    if (!found.called && table.find(found.name) && known.count(found.name) == 0) return true;
  return false;
}

// Lengths, masses and times in SI. An angle has no unit of its own: keys take degrees, formulas radians.
std::optional<double> parameter_value(const std::string& text, const Parameters& known, std::string& fault) {
  const auto split = split_unit(text);
  const auto plain = value_of(with_parameters(text, known), fault);
  if (plain || !split) return plain;
  if (split->unit.powers[3] != 0) {
    fault = fmt::format("\"{}\" is an angle; write a parameter in the unit of the keys that use it", text);
    return std::nullopt;
  }
  const auto number = value_of(with_parameters(split->number, known), fault);
  return number ? std::optional(*number * split->unit.factor) : std::nullopt;
}

// The first name in an expression that is neither a parameter nor one of the language.
std::optional<std::string> unknown_in(const std::string& text, const Parameters& parameters) {
  for (const NameInText& found : names_in(text))
    if (!found.called && parameters.count(found.name) == 0 && (is_free_name(found.name) || found.name.size() == 1))
      return found.name;
  return std::nullopt;
}

void refuse(SceneContext& context, const TomlEntry& one, const std::string& why) {
  context.report("parameters." + one.key, one.line, "parameters." + one.key + why);
}

// Parameters that are plain numbers. Returns those that are expressions.
std::vector<const TomlEntry*> take_numbers(SceneContext& context, const TomlNode& table, Parameters& known) {
  std::vector<const TomlEntry*> open;
  for (const TomlEntry& one : table.entries) {
    const bool number = one.value.kind == TomlNode::Kind::number || one.value.kind == TomlNode::Kind::integer;
    if (!is_free_name(one.key))
      refuse(context, one, ": a parameter's name is a word that formulas do not know yet");
    else if (number && std::isfinite(one.value.number))
      known[one.key] = one.value.number;
    else if (one.value.kind == TomlNode::Kind::text)
      open.push_back(&one);
    else
      refuse(context, one, " must be a number or an expression, not " + describe(one.value));
  }
  return open;
}

}  // namespace

bool is_free_name(const std::string& name) {
  const bool word = !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                    std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  return word && fault_of_names(name).has_value() && fault_of_names(name + "(1)").has_value();
}

std::string with_parameters(const std::string& text, const Parameters& parameters) {
  if (parameters.empty()) return text;
  std::string replaced;
  std::size_t from = 0;
  for (const NameInText& found : names_in(text)) {
    const auto known = parameters.find(found.name);
    if (found.called || known == parameters.end()) continue;
    replaced += text.substr(from, found.at - from) + "(" + number_text(known->second) + ")";
    from = found.at + found.name.size();
  }
  return replaced + text.substr(from);
}

std::optional<double> number_of(const std::string& text, const Option& option, const Parameters& parameters,
                                std::string& fault) {
  if (const auto plain = value_of(with_parameters(text, parameters), fault)) return plain;
  const auto split = split_unit(text);
  const auto factor = split ? factor_between(split->unit, option.unit) : std::nullopt;
  if (split && !factor) {
    fault = fmt::format("is in {}; it must be {}", split->name,
                        option.unit.empty() ? "a number without a unit" : "in " + option.unit);
    return std::nullopt;
  }
  const std::string number = split ? split->number : text;
  if (const auto unknown = unknown_in(number, parameters))
    fault = fmt::format("has \"{}\", which is no parameter", *unknown);
  else if (const auto value = split ? value_of(with_parameters(number, parameters), fault) : std::nullopt)
    return *value * *factor;
  else
    fault = "is no number: " + fault;
  return std::nullopt;
}

Parameters read_parameters(SceneContext& context, const TomlNode& root) {
  Parameters known;
  const TomlEntry* entry = root.find("parameters");
  if (!entry) return known;
  if (entry->value.kind != TomlNode::Kind::table) {
    context.report("parameters", entry->line, "parameters must be a table, written [parameters]");
    return known;
  }
  std::vector<const TomlEntry*> open = take_numbers(context, entry->value, known);
  for (std::size_t before = 0; before != open.size();) {
    before = open.size();
    std::erase_if(open, [&](const TomlEntry* one) {
      if (waits(one->value.text, entry->value, known)) return false;
      std::string fault;
      const auto value = parameter_value(one->value.text, known, fault);
      known[one->key] = value.value_or(1);  // those that need it have no fault of their own
      if (!value) refuse(context, *one, ": " + fault);
      return true;
    });
  }
  for (const TomlEntry* one : open)
    refuse(context, *one,
           fmt::format(" = \"{}\" depends on a parameter that has no value, or on itself", one->value.text));
  return known;
}

Parameters read_signals(SceneContext& context, const TomlNode& root) {
  declare_signals({});
  Parameters signals;
  const TomlEntry* entry = root.find("signals");
  if (!entry) return signals;
  if (entry->value.kind != TomlNode::Kind::table) {
    context.report("signals", entry->line, "signals must be a table, written [signals]");
    return signals;
  }
  for (const TomlEntry& one : entry->value.entries) {
    const std::string path = "signals." + one.key;
    const bool number = one.value.kind == TomlNode::Kind::number || one.value.kind == TomlNode::Kind::integer;
    if (!is_free_name(one.key) || context.parameters.count(one.key) > 0)
      context.report(path, one.line, path + ": a signal's name is a word that formulas and parameters do not know yet");
    else if (number && std::isfinite(one.value.number))
      signals[one.key] = one.value.number;
    else
      context.report(path, one.line, path + " must be a number, its value at the start, not " + describe(one.value));
  }
  declare_signals(signals);
  return signals;
}

}  // namespace seiche
