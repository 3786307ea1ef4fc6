#pragma once
// Mistakes on the command line in words.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace seiche {

// What is wrong with these arguments, after the parser refused them: misspelt verbs and options with the nearest right
// ones, all else in the parser's words.
std::string describe_mistake(const CLI::App& program, const CLI::ParseError& refusal,
                             const std::vector<std::string>& arguments);

}  // namespace seiche
