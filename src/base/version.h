#pragma once
#include <string>

namespace seiche {

// The version of this build, "major.minor.patch".
std::string version();

}  // namespace seiche
