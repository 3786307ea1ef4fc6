#pragma once
// A table that grows during a run, and its length and checksum as stored in checkpoints.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "files/checked_file.h"

namespace seiche {

// Length and checksum of a table at a checkpoint.
struct TableMark {
  std::uint64_t bytes = 0;
  std::optional<std::uint32_t> checksum;  // CRC-32C; absent in checkpoints of earlier builds
};

class TableFile {
 public:
  // Opens the table, truncated to `keep` bytes, or starts it with its header. Throws Error(output_failed).
  TableFile(const std::filesystem::path& path, std::uint64_t keep, const std::string& header);

  void append(const std::string& text);
  void flush() { file_.flush(); }
  void sync() { file_.sync(); }
  TableMark mark() const { return {file_.size(), checksum_}; }

 private:
  AppendFile file_;
  std::uint32_t checksum_;
};

// Reason why the table differs from the mark, or "".
std::string fault_of_table(const std::filesystem::path& path, const TableMark& mark);

// Number of bytes of the complete lines among the first `most` bytes; 0 if there is no file.
std::uint64_t whole_lines(const std::filesystem::path& path, std::uint64_t most);

}  // namespace seiche
