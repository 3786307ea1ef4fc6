#pragma once
// The JSON schema of scenes, for editors that complete and check TOML (taplo, Even Better TOML).
#include <string>

namespace seiche {

// Draft 7, from the table of keys that the reader uses. It knows tables, types, names and required keys; what keys ask
// of each other only `seiche check` knows.
std::string scene_schema();

}  // namespace seiche
