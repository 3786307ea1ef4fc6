#include "command_line.h"

#include <fmt/format.h>

#include "base/suggest.h"

namespace seiche {
namespace {

std::vector<std::string> verbs_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

const CLI::App* find_verb(const CLI::App& program, const std::string& name) {
  for (const CLI::App* verb : program.get_subcommands({}))
    if (verb->get_name() == name) return verb;
  return nullptr;
}

// Long options listed by --help.
std::vector<std::string> options_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string with_suggestion(const std::string& what, const std::string& word, const std::vector<std::string>& known) {
  const auto near = suggest(word, known);
  return fmt::format("unknown {} '{}'{}", what, word, near ? fmt::format("; did you mean '{}'?", *near) : "");
}

std::string unknown_option(const CLI::App& verb, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (!argument.starts_with("-") || argument == "--") continue;
    const std::string name = argument.substr(0, argument.find('='));
    if (verb.get_option_no_throw(name) == nullptr)
      return with_suggestion("option", name, options_of(verb)) +
             fmt::format("; see `seiche {} --help`", verb.get_name());
  }
  return {};
}

}  // namespace

std::string explain_unknown_verb(const CLI::App& program, const std::string& name) {
  const std::vector<std::string> verbs = verbs_of(program);
  return with_suggestion("verb", name, verbs) + fmt::format("; verbs: {}; see `seiche --help`", fmt::join(verbs, ", "));
}

std::string describe_mistake(const CLI::App& program, const CLI::ParseError& refusal,
                             const std::vector<std::string>& arguments) {
  const bool has_word = !arguments.empty() && !arguments[0].starts_with("-");
  const CLI::App* verb = has_word ? find_verb(program, arguments[0]) : nullptr;
  if (has_word && verb == nullptr) return explain_unknown_verb(program, arguments[0]);
  if (verb != nullptr && dynamic_cast<const CLI::ExtrasError*>(&refusal) != nullptr) {
    const std::string text = unknown_option(*verb, {arguments.begin() + 1, arguments.end()});
    if (!text.empty()) return text;
  }
  return fmt::format("{}; see `seiche {}--help`", refusal.what(), verb != nullptr ? verb->get_name() + " " : "");
}

}  // namespace seiche
