#pragma once
// Every file Seiche writes goes through here: each system call is checked, and a file gets its final name only when all
// of its bytes are on the disk.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace seiche {

// Writes bytes to `path`.tmp, syncs, renames to `path` and syncs the folder. On failure the temporary file is removed
// and Error(output_failed) names the path, the cause and the free bytes; an older file at `path` is left as it was.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// Replaces the first bytes of an existing file and syncs. Throws Error(output_failed).
void overwrite_start(const std::filesystem::path& path, std::string_view bytes);

// Creates the folder and its parents where missing; throws Error(output_failed).
void make_folder(const std::filesystem::path& folder);

// Makes renames and new names in the folder durable; throws Error(output_failed).
void sync_folder(const std::filesystem::path& folder);

// Renames and syncs the parent folder; throws Error(output_failed).
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

// The whole file. Throws Error(bad_checkpoint) naming the path and the cause.
std::string read_whole_file(const std::filesystem::path& path);

// The message of a failed write: path, what failed, errno's text and the bytes free on that file system.
std::string describe_failure(const std::filesystem::path& path, const std::string& action, int error_number);

// A file that grows during the run (CSV, log). Text is collected and written out by flush().
class AppendFile {
 public:
  // Opens (creating if missing) and cuts the file to `keep` bytes when it is longer. Throws Error(output_failed).
  AppendFile(std::filesystem::path path, std::uint64_t keep);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view text) { pending_ += text; }
  void flush();  // writes what was appended; throws Error(output_failed)
  void sync();   // flush and fsync; throws Error(output_failed), also where the name no longer leads to the file
  std::uint64_t size() const { return size_ + pending_.size(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  void check_name() const;

  std::filesystem::path path_;
  int handle_ = -1;
  std::uint64_t size_ = 0;
  std::string pending_;
};

}  // namespace seiche
