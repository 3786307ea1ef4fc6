#pragma once
// What a frame, a checkpoint or a run directory holds, in words.
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Lines of text about the path: a .vdb frame, a folder checkpoints/NNNNNNNN (or a file in it), or a run directory.
// Throws Error(bad_input) when it is none of these, Error(bad_checkpoint) when a checkpoint does not verify.
std::vector<std::string> describe_path(const std::filesystem::path& path);

// The three kinds.
std::vector<std::string> describe_frame(const std::filesystem::path& file);
std::vector<std::string> describe_checkpoint(const std::filesystem::path& folder);
std::vector<std::string> describe_run(const std::filesystem::path& folder);

// The value of a key at the top level of a JSON object as it stands there, strings without their quotes and escapes;
// empty if there is no such key.
std::string json_value(const std::string& json, const std::string& key);

}  // namespace seiche
