#pragma once
// One rank's checkpoint file as bytes: fixed header (magic, endianness, format version, precision), named data, and a
// final CRC-32C over everything.
#include <cstdint>
#include <string>

#include "base/checkpoint_data.h"

namespace seiche {

constexpr std::uint32_t checkpoint_format_version = 1;

struct CheckpointFile {
  int dimension = 3;
  int rank = 0, ranks = 1;
  std::int64_t step = 0;
  std::string scene_hash;
  std::string creator;
  CheckpointData data;
};

std::string encode_checkpoint_file(const CheckpointFile& file);

// Reason why a checkpoint file is unusable.
struct CheckpointDefect {
  enum class Kind { none, damaged, foreign } kind = Kind::none;  // foreign: intact, but of another version or machine
  std::string text;
};

// Checks header and checksum only.
CheckpointDefect examine_checkpoint_file(const std::string& bytes);

// Throws Error(bad_checkpoint) if examine_checkpoint_file() finds a defect or the contents are inconsistent.
CheckpointFile decode_checkpoint_file(const std::string& bytes);

}  // namespace seiche
