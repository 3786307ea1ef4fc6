#pragma once
#include <string>

namespace seiche {

// The version of this build, "major.minor.patch".
std::string version();

// Equal for builds whose runs give the same: of the sources that make runs, the compiler and its flags
// (cmake/SeicheDigest.cmake).
std::string build_digest();

}  // namespace seiche
