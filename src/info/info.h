#pragma once
// Describes the contents of a frame, a checkpoint or a run directory in words.
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Lines of text about the path: a .vdb frame, a folder checkpoints/NNNNNNNN (or a file in it), or a run directory.
// Throws Error(bad_input) if it is none of these, Error(bad_checkpoint) if a checkpoint does not verify.
std::vector<std::string> describe_path(const std::filesystem::path& path);

// The three kinds of describe_path().
std::vector<std::string> describe_frame(const std::filesystem::path& file);
std::vector<std::string> describe_checkpoint(const std::filesystem::path& folder);
std::vector<std::string> describe_run(const std::filesystem::path& folder);

}  // namespace seiche
