#pragma once
#include <string>

namespace seiche {

// Reference of all scene keys as Markdown, generated from the reader's table.
std::string scene_reference();

}  // namespace seiche
