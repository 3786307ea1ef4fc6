#pragma once
// What the program prints.
#include <fmt/format.h>

#include <string>

#include "run/log.h"

namespace seiche {

void print_error(const std::string& message);  // "seiche: ..." on the error output

// Ordinary lines go to the output, warnings to the error output; a live line where the output is a terminal.
Console terminal_console();

}  // namespace seiche
