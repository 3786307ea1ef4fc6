#pragma once
// The folders of checkpoints/.
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Names of the folders that are steps ("00000120"), newest first, committed or not.
std::vector<std::string> checkpoints_newest_first(const std::filesystem::path& folder);

// Removal is tidying: what cannot be removed does no harm.
void remove_checkpoint(const std::filesystem::path& folder);

// Removes all but the newest committed ones, and unfinished ones of earlier sessions.
void remove_old_checkpoints(const std::filesystem::path& folder, std::size_t keep);

}  // namespace seiche
