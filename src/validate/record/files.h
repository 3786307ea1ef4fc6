#pragma once
// Files that several validations may write at once.
#include <filesystem>
#include <string_view>

namespace seiche {

// While it lives no other process or thread of this machine has the lock of the same folder; waits for it. Leaves
// nothing behind. Throws Error(output_failed).
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int handle_ = -1;
};

// Where a file lies, links followed, so that a link stays one.
std::filesystem::path target_of(const std::filesystem::path& file);

// The folder that a file is in, links followed.
std::filesystem::path folder_of(const std::filesystem::path& file);

// As write_file() by way of a temporary file that no other writer has. Throws Error(output_failed).
void replace_file(const std::filesystem::path& file, std::string_view bytes);

// Throws Error(output_failed) naming the file where replace_file() could not write it, or would replace a folder or a
// device; what is there stays as it is.
void check_writable(const std::filesystem::path& file);

}  // namespace seiche
