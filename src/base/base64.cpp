#include "base/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace seiche {
namespace {

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr int foreign = -1;

constexpr std::array<int, 256> values_of_letters() {
  std::array<int, 256> values{};
  values.fill(foreign);
  for (std::size_t n = 0; n < letters.size(); ++n) values[static_cast<unsigned char>(letters[n])] = int(n);
  return values;
}
constexpr std::array<int, 256> values = values_of_letters();

// Number of '=' at the end, two at most.
std::size_t padding_of(std::string_view text) {
  const std::size_t last = text.find_last_not_of('=');
  return std::min<std::size_t>(2, text.size() - (last == std::string_view::npos ? 0 : last + 1));
}

}  // namespace

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve(base64_length(bytes.size()));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < left; ++n) group |= std::uint32_t(std::uint8_t(bytes[i + n])) << (16 - 8 * n);
    for (std::size_t n = 0; n < 4; ++n) text += n <= left ? letters[group >> (18 - 6 * n) & 63] : '=';
  }
  return text;
}

std::optional<std::string> decode_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  text.remove_suffix(padding_of(text));
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value == foreign) return std::nullopt;
    group = (group << 6 | std::uint32_t(value)) & 0xfff;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(char(group >> bits & 0xff));
  }
  if ((group & ((1u << bits) - 1)) != 0) return std::nullopt;
  return bytes;
}

}  // namespace seiche
