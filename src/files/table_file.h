#pragma once
// A table that grows during a run, and how it stood when a checkpoint was written.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "files/checked_file.h"

namespace seiche {

// The first bytes of a table as a checkpoint knows them.
struct TableMark {
  std::uint64_t bytes = 0;
  std::optional<std::uint32_t> checksum;  // CRC-32C; checkpoints of earlier builds have none
};

class TableFile {
 public:
  // Opens the table, cut to `keep` bytes, or begins it with its header. Throws Error(output_failed).
  TableFile(const std::filesystem::path& path, std::uint64_t keep, const std::string& header);

  void append(const std::string& text);
  void flush() { file_.flush(); }
  void sync() { file_.sync(); }
  TableMark mark() const { return {file_.size(), checksum_}; }

 private:
  AppendFile file_;
  std::uint32_t checksum_;
};

// Why the table is not the one that was marked, or "".
std::string fault_of_table(const std::filesystem::path& path, const TableMark& mark);

// Bytes of the whole lines among the first `most` bytes; 0 where there is no file.
std::uint64_t whole_lines(const std::filesystem::path& path, std::uint64_t most);

}  // namespace seiche
