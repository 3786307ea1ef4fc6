#pragma once
// Options that several verbs have.
#include <CLI/CLI.hpp>
#include <vector>

#include "run/command.h"
#include "verbs.h"

namespace seiche {

void add_set_option(CLI::App& verb, std::vector<Override>& overrides);  // --set KEY=VALUE

Surroundings surroundings(const VerbContext& context);

}  // namespace seiche
