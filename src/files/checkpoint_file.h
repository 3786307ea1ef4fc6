#pragma once
// One rank's file of a checkpoint as bytes: a fixed header (magic, endianness, format version, precision), the named
// data, and a CRC-32C over all of it at the end.
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

// Why bytes are not a checkpoint file that this program can use.
struct CheckpointDefect {
  enum class Kind { none, damaged, foreign } kind = Kind::none;  // foreign: intact, but of another version or machine
  std::string text;
};

// Looks at header and checksum only.
CheckpointDefect examine_checkpoint_file(const std::string& bytes);

// Throws Error(bad_checkpoint) when examine_checkpoint_file() finds a defect or the contents do not hold together.
CheckpointFile decode_checkpoint_file(const std::string& bytes);

}  // namespace seiche
