#include "files/checkpoint_folders.h"

#include <algorithm>

namespace seiche {
namespace fs = std::filesystem;

std::vector<std::string> checkpoints_newest_first(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool is_step = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
    if (is_step && entry.is_directory(error)) names.push_back(name);
  }
  const auto newer = [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() > b.size() : a > b;
  };
  std::sort(names.begin(), names.end(), newer);
  return names;
}

void remove_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

void remove_old_checkpoints(const fs::path& folder, std::size_t keep) {
  std::size_t committed = 0;
  for (const std::string& name : checkpoints_newest_first(folder)) {
    const bool complete = fs::exists(folder / name / "COMMIT");
    if (!complete || ++committed > keep) remove_checkpoint(folder / name);
  }
  // Remains of a killed run.
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".tmp") remove_checkpoint(entry.path());
  }
}

}  // namespace seiche
