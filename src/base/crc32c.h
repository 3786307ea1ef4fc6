#pragma once
// CRC-32C (Castagnoli), the checksum of checkpoints and frames.
#include <cstdint>
#include <string_view>

namespace seiche {

std::uint32_t crc32c(std::string_view bytes);

}  // namespace seiche
