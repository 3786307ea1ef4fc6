#pragma once
// Lists and removes the folders in checkpoints/.
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Names of step folders ("00000120"), newest first, committed or not.
std::vector<std::string> checkpoints_newest_first(const std::filesystem::path& folder);

// Errors are ignored: a folder that cannot be removed does no harm.
void remove_checkpoint(const std::filesystem::path& folder);

// Removes all but the newest `keep` committed checkpoints, and unfinished ones of earlier sessions.
void remove_old_checkpoints(const std::filesystem::path& folder, std::size_t keep);

}  // namespace seiche
