#pragma once
// Explains mistakes on the command line.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace seiche {

// Explains why the parser refused these arguments: for misspelt verbs and options with the nearest valid ones,
// otherwise in the parser's words.
std::string describe_mistake(const CLI::App& program, const CLI::ParseError& refusal,
                             const std::vector<std::string>& arguments);

// Says that there is no such verb, with the nearest one and all of them.
std::string explain_unknown_verb(const CLI::App& program, const std::string& name);

}  // namespace seiche
