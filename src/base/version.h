#pragma once
#include <string>

namespace seiche {

// The version of this build, "major.minor.patch".
std::string version();

// Digest of the sources that affect a run's results, of the compiler and of its flags (cmake/SeicheDigest.cmake). Equal
// for builds whose runs give the same results.
std::string build_digest();

}  // namespace seiche
