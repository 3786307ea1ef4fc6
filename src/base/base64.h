#pragma once
// Base64 as RFC 4648 has it: bytes as text of 64 letters, digits and signs.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace seiche {

// Letters that a number of bytes takes, padding counted.
constexpr std::size_t base64_length(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

std::string encode_base64(std::string_view bytes);

// Bytes of a text; nothing for a text with foreign characters (white space counts), padding elsewhere than at its end,
// an incomplete group of four, or bits set beyond the last byte.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace seiche
