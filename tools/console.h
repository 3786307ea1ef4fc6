#pragma once
// Console output of the program.
#include <fmt/format.h>

#include <string>

#include "run/log.h"

namespace seiche {

void print_error(const std::string& message);  // "seiche: ..." on stderr

// Ordinary lines go to stdout, warnings to stderr; the live line only to a terminal.
Console terminal_console();

}  // namespace seiche
