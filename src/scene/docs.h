#pragma once
#include <string>

namespace seiche {

// The reference of all scene keys as Markdown, made from the table that the reader uses.
std::string scene_reference();

}  // namespace seiche
