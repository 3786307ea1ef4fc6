#pragma once
// Files that concurrent validations may write.
#include <filesystem>
#include <string_view>

namespace seiche {

// Exclusive lock of a folder among processes and threads of this machine; the constructor waits for it. Leaves no file
// behind. Throws Error(output_failed).
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int handle_ = -1;
};

// Target of a file, with links resolved, so that links are preserved.
std::filesystem::path target_of(const std::filesystem::path& file);

// Folder of a file, with links resolved.
std::filesystem::path folder_of(const std::filesystem::path& file);

// Like write_file(), with a temporary file of a unique name. Throws Error(output_failed).
void replace_file(const std::filesystem::path& file, std::string_view bytes);

// Throws Error(output_failed) naming the file if replace_file() could not write it, or would replace a folder or a
// device. Changes nothing.
void check_writable(const std::filesystem::path& file);

}  // namespace seiche
