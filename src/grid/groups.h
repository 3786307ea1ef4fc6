#pragma once
// Quick tests of eight neighbouring values of a row, with which loops skip empty space. The compiler vectorises them.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace seiche {

constexpr int a_group = 8;

namespace detail {

inline std::uint64_t eight_marks(const char* marks) {
  static_assert(sizeof(std::uint64_t) == a_group);
  std::uint64_t all;
  std::memcpy(&all, marks, sizeof all);
  return all;
}

inline std::uint64_t bits_of_any(const double* f) {
  std::uint64_t bits = 0;
  for (int k = 0; k < a_group; ++k) bits |= std::bit_cast<std::uint64_t>(f[k]);
  return bits;
}

}  // namespace detail

inline bool any_marked(const char* marks) {
  return detail::eight_marks(marks) != 0;
}

// Haycock's test for a zero byte.
inline bool all_marked(const char* marks) {
  const std::uint64_t v = detail::eight_marks(marks);
  return ((v - 0x0101010101010101u) & ~v & 0x8080808080808080u) == 0;
}

// True for -0, too.
inline bool any_negative(const double* f) {
  return detail::bits_of_any(f) >> 63 != 0;
}

// False for -0.
inline bool all_zero(const double* f) {
  return detail::bits_of_any(f) << 1 == 0;
}

// False if one is not a number.
inline bool all_above(const double* f, double limit) {
  int below = 0;
  for (int k = 0; k < a_group; ++k) below |= !(f[k] > limit);
  return below == 0;
}

inline bool any_within(const double* f, double limit) {
  int within = 0;
  for (int k = 0; k < a_group; ++k) within |= std::abs(f[k]) < limit;
  return within != 0;
}

// False for infinity and where one is not a number.
inline bool all_finite(const double* f) {
  int wrong = 0;
  for (int k = 0; k < a_group; ++k) wrong |= !(f[k] - f[k] == 0);
  return wrong == 0;
}

}  // namespace seiche
