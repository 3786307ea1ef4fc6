#pragma once
// CRC-32C (Castagnoli), the checksum of checkpoints, tables and frames.
#include <cstdint>
#include <string_view>

namespace seiche {

// `before`: the checksum of the preceding bytes.
std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0);

}  // namespace seiche
