// Verbs that describe the program, for people, shells and editors: help, completion, manual page, schema of scenes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/version.h"
#include "command_line.h"
#include "info/schema.h"
#include "verbs.h"

namespace seiche {
namespace {

// Options with a name that help shows.
std::vector<const CLI::Option*> shown_options(const CLI::App& verb) {
  std::vector<const CLI::Option*> shown;
  for (const CLI::Option* option : verb.get_options())
    if (!option->get_group().empty() && !option->get_lnames().empty()) shown.push_back(option);
  return shown;
}

std::vector<const CLI::App*> shown_verbs(const CLI::App& program) {
  std::vector<const CLI::App*> shown;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    if (!verb->get_group().empty()) shown.push_back(verb);
  return shown;
}

std::string option_words(const CLI::App& verb) {
  std::string words;
  for (const CLI::Option* option : shown_options(verb)) words += " --" + option->get_lnames()[0];
  return words;
}

std::string words_of_verbs(const CLI::App& program) {
  std::string words;
  for (const CLI::App* verb : shown_verbs(program)) words += (words.empty() ? "" : " ") + verb->get_name();
  return words;
}

// Words that a verb takes in place of a file; empty: it takes files.
std::vector<std::string> words_after(const CLI::App& verb, const CLI::App& program) {
  if (verb.get_name() == "completion") return {"bash", "zsh", "fish"};
  std::vector<std::string> words;
  if (verb.get_name() == "help")
    for (const CLI::App* other : shown_verbs(program)) words.push_back(other->get_name());
  return words;
}

std::string bash_completion(const CLI::App& program) {
  std::string text = fmt::format(
      "# bash completion of seiche: source <(seiche completion bash)\n_seiche() {{\n"
      "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" words=\"\" named=\"\"\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then words=\"{} --help --version\"; else\n"
      "    case \"${{COMP_WORDS[1]}}\" in\n",
      words_of_verbs(program));
  for (const CLI::App* verb : shown_verbs(program)) {
    const std::vector<std::string> named = words_after(*verb, program);
    text += fmt::format("      {}) {}words=\"{}{}\" ;;\n", verb->get_name(), named.empty() ? "" : "named=1; ",
                        named.empty() ? "" : fmt::format("{} ", fmt::join(named, " ")), option_words(*verb).substr(1));
  }
  return text +
         "    esac\n  fi\n"
         "  case \"$word\" in -*) ;; *) [ \"$COMP_CWORD\" -gt 1 ] && [ -z \"$named\" ] && return ;; esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n}\ncomplete -o default -F _seiche seiche\n";
}

// Text between single quotes of zsh and fish.
std::string quoted(std::string text) {
  std::erase(text, '\'');
  return "'" + text + "'";
}

std::string zsh_completion(const CLI::App& program) {
  std::string text =
      "#compdef seiche\n# zsh completion of seiche: save as _seiche in a folder of $fpath\n_seiche() {\n"
      "  if (( CURRENT == 2 )); then\n    local -a verbs=(\n";
  for (const CLI::App* verb : shown_verbs(program))
    text += fmt::format("      {}\n", quoted(verb->get_name() + ":" + verb->get_description()));
  text += "    )\n    _describe verb verbs\n    return\n  fi\n  case $words[2] in\n";
  for (const CLI::App* verb : shown_verbs(program)) {
    text += fmt::format("    {}) _arguments", verb->get_name());
    for (const CLI::Option* option : shown_options(*verb)) {
      std::string doc = option->get_description();
      std::replace_if(
          doc.begin(), doc.end(), [](char c) { return c == '[' || c == ']' || c == ':'; }, ' ');
      const std::string value = option->get_expected_min() > 0 ? ":value:_files" : "";
      text += " " + quoted(fmt::format("--{}[{}]{}", option->get_lnames()[0], doc, value));
    }
    const std::vector<std::string> named = words_after(*verb, program);
    text += named.empty() ? " '*:file:_files' ;;\n" : fmt::format(" '1:word:({})' ;;\n", fmt::join(named, " "));
  }
  return text + "  esac\n}\n_seiche \"$@\"\n";
}

std::string fish_completion(const CLI::App& program) {
  std::string text = "# fish completion of seiche: seiche completion fish > ~/.config/fish/completions/seiche.fish\n";
  for (const CLI::App* verb : shown_verbs(program)) {
    text += fmt::format("complete -c seiche -n __fish_use_subcommand -f -a {} -d {}\n", verb->get_name(),
                        quoted(verb->get_description()));
    for (const CLI::Option* option : shown_options(*verb))
      text += fmt::format("complete -c seiche -n '__fish_seen_subcommand_from {}' -l {} {}-d {}\n", verb->get_name(),
                          option->get_lnames()[0], option->get_expected_min() > 0 ? "-r " : "",
                          quoted(option->get_description()));
    for (const std::string& word : words_after(*verb, program))
      text += fmt::format("complete -c seiche -n '__fish_seen_subcommand_from {}' -f -a {}\n", verb->get_name(), word);
  }
  return text;
}

// Text of a manual page: a dash would be a hyphen, and a dot or a quote at the start of a line a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '-' ? std::string("\\-") : c == '\\' ? std::string("\\e") : std::string(1, c);
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string manual_of(const CLI::App& verb) {
  std::string text = fmt::format(".SS seiche {}", roff(verb.get_name()));
  for (const CLI::Option* option : verb.get_options())
    if (option->get_positional()) text += fmt::format(" {}", roff(option->get_name(true)));
  text += fmt::format("\n{}.\n", roff(verb.get_description()));
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_group().empty()) continue;
    const bool named = !option->get_lnames().empty();
    const std::string name = named ? "--" + option->get_lnames()[0] : option->get_name(true);
    const std::string value =
        named && option->get_expected_max() > 0 ? " \\fI" + roff(option->get_type_name()) + "\\fR" : "";
    text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(name), value, roff(option->get_description()));
  }
  return text;
}

std::string manual(const CLI::App& program) {
  std::string text = fmt::format(
      ".TH SEICHE 1 \"\" \"seiche {}\" \"User Commands\"\n.SH NAME\nseiche \\- {}\n.SH SYNOPSIS\n.B seiche\n"
      "\\fIverb\\fR [\\fIoptions\\fR]\n.br\n.B mpirun \\-n 4 seiche run\n\\fIscene.toml\\fR\n.SH VERBS\n",
      roff(version()), "liquid among moving and deforming solids");
  for (const CLI::App* verb : shown_verbs(program)) text += manual_of(*verb);
  return text +
         ".SH EXIT STATUS\n0 done; 1 internal error; 2 command line, scene or input file wrong; 3 the simulation could "
         "not go on;\n4 output could not be written; 5 the machine cannot; 6 a checkpoint cannot be used;\n75 stopped "
         "on request, resume continues; 124 a rank hung.\n.SH SEE ALSO\nThe pages in share/doc/seiche.\n";
}

void print_on_root(const VerbContext& context, const std::string& text) {
  if (context.ranks.is_root()) fmt::print("{}", text);
}

// Help of the program, or of a verb. CLI::App::help() of the program would be that of the verb `help`.
std::string help_on(const CLI::App& program, const std::string& name) {
  if (name.empty()) return program.get_formatter()->make_help(&program, program.get_name(), CLI::AppFormatMode::Normal);
  for (const CLI::App* verb : shown_verbs(program))
    if (verb->get_name() == name) return verb->help(program.get_name());
  throw Error(ExitCode::bad_input, explain_unknown_verb(program, name));
}

}  // namespace

void add_help(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("help", "Show the verbs, or the options of one");
  auto name = std::make_shared<std::string>();
  verb->add_option("verb", *name, "Verb to explain");
  verb->callback([name, &program, &context] {
    context.action = [name, &program, &context] {
      print_on_root(context, help_on(program, *name));
      return ExitCode::done;
    };
  });
}

void add_completion(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("completion", "Print a completion script for a shell");
  auto shell = std::make_shared<std::string>();
  verb->add_option("shell", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->callback([shell, &program, &context] {
    context.action = [shell, &program, &context] {
      print_on_root(context, *shell == "bash"  ? bash_completion(program)
                             : *shell == "zsh" ? zsh_completion(program)
                                               : fish_completion(program));
      return ExitCode::done;
    };
  });
}

void add_manual(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("manual", "Print the manual page, for man -l -");
  verb->callback([&program, &context] {
    context.action = [&program, &context] {
      print_on_root(context, manual(program));
      return ExitCode::done;
    };
  });
}

void add_schema(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("schema", "Print the JSON schema of scenes, for editors that complete TOML");
  verb->callback([&context] {
    context.action = [&context] {
      print_on_root(context, scene_schema());
      return ExitCode::done;
    };
  });
}

}  // namespace seiche
