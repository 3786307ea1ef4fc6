#pragma once
// The example scenes that came with the program (`seiche init`).
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

struct Example {
  std::string name, title;
};

// Scenes in a folder, by name, with the titles in their files.
std::vector<Example> list_examples(const std::filesystem::path& folder);

// Copies scene NAME.toml of the folder to `target`, and the files that it names to the same places beside it. Returns
// what was written. Throws Error(bad_input) if there is no such example, or if a file is there with other contents
// unless `overwrite`; Error(output_failed).
enum class Existing { keep, replace };
std::vector<std::filesystem::path> copy_example(const std::filesystem::path& folder, const std::string& name,
                                                const std::filesystem::path& target, Existing existing);

}  // namespace seiche
