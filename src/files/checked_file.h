#pragma once
// All files are written through here. Each system call is checked. A file gets its final name only after all of its
// bytes are on the disk.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace seiche {

// Writes bytes to `path`.tmp, syncs, renames to `path` and syncs the folder. On failure removes the temporary file,
// keeps an older file at `path`, and throws Error(output_failed) naming the path, the cause and the free bytes.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// The same with bytes that `produce` gives to its argument piece by piece.
using ByteSink = std::function<void(std::string_view)>;
void write_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce);

// Replaces the first bytes of an existing file and syncs. Throws Error(output_failed).
void overwrite_start(const std::filesystem::path& path, std::string_view bytes);

// Creates the folder and its parents where missing; throws Error(output_failed).
void make_folder(const std::filesystem::path& folder);

// Makes renames and new names in the folder durable (fsync); throws Error(output_failed).
void sync_folder(const std::filesystem::path& folder);

// Renames and syncs the parent folder; throws Error(output_failed).
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

// Reads the whole file. Throws Error(bad_checkpoint) naming the path and the cause.
std::string read_whole_file(const std::filesystem::path& path);

// Message of a failed write: path, failed action, errno's text and the free bytes of that file system.
std::string describe_failure(const std::filesystem::path& path, const std::string& action, int error_number);

// A file that grows during the run (CSV, log). append() buffers text, flush() writes it.
class AppendFile {
 public:
  // Opens the file (creates it if missing) and truncates it to `keep` bytes if it is longer. Throws
  // Error(output_failed).
  AppendFile(std::filesystem::path path, std::uint64_t keep);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view text) { pending_ += text; }
  void flush();  // writes the buffered text; throws Error(output_failed)
  void sync();   // flush and fsync; throws Error(output_failed), also if the name no longer refers to the file
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
