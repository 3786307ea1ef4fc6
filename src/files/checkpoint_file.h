#pragma once
// One rank's checkpoint file: fixed header (magic, endianness, format version, precision), named data, and a final
// CRC-32C over everything. Format 1 stores all values of a field, format 2 packed ones. Both are read.
#include <cstdint>
#include <string>

#include "base/checkpoint_data.h"
#include "files/checked_file.h"

namespace seiche {

constexpr std::uint32_t checkpoint_format_version = 2, oldest_checkpoint_format = 1;

struct CheckpointHeader {
  int dimension = 3;
  int rank = 0, ranks = 1;
  std::int64_t step = 0;
  std::string scene_hash;
  std::string creator;
};

struct CheckpointFile {
  CheckpointHeader header;
  CheckpointData data;
};

struct WrittenBytes {
  std::uint64_t count = 0;
  std::uint32_t checksum = 0;
};

// Gives the file to `sink` piece by piece.
WrittenBytes write_checkpoint_file(const CheckpointHeader& header, const CheckpointData& data, const ByteSink& sink);

// Reason why a checkpoint file is unusable.
struct CheckpointDefect {
  enum class Kind { none, damaged, foreign } kind = Kind::none;  // foreign: intact, but of another version or machine
  std::string text;

  static CheckpointDefect damaged(const std::string& text) { return {Kind::damaged, text}; }
  static CheckpointDefect foreign(const std::string& text) { return {Kind::foreign, text}; }
};

// Text if this program does not read that format, else empty.
std::string unknown_format(std::uint32_t version);

// Checks header and checksum only.
CheckpointDefect examine_checkpoint_file(const std::string& bytes);

// Throws Error(bad_checkpoint) if examine_checkpoint_file() finds a defect or the contents are inconsistent.
CheckpointFile decode_checkpoint_file(const std::string& bytes);

}  // namespace seiche
