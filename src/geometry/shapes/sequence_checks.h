#pragma once
// Checks of the motion from one mesh of a sequence to the next.
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

class MeshSequence;

// Throws Error(bad_input) naming `where`, two files and the time if the surface crosses itself or collapses while its
// points move from one mesh to the next. Looks at seven times, or at fewer, at least the middle, where meshes
// are large.
void require_simple_between(const MeshSequence& sequence, const std::vector<std::filesystem::path>& files,
                            const std::string& where);

}  // namespace seiche
