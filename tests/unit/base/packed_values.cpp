// Packed values unpack to the same bits and take no room where values are repeated.
#include "base/packed_values.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace packed_values_tests {
using namespace seiche;

namespace {

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double v : values) bits.push_back(std::bit_cast<std::uint64_t>(v));
  return bits;
}

void check_round_trip(const std::vector<double>& values) {
  const PackedValues packed(values);
  CHECK(packed.size() == values.size());
  CHECK(bits_of(packed.unpack()) == bits_of(values));
  const auto back = PackedValues::from_words(packed.words(), values.size());
  REQUIRE(back);
  CHECK(*back == packed);
  CHECK(packed.words().size() <= values.size() + values.size() / 3 + 2);  // a head for each block of at least three
}

}  // namespace

TEST_CASE("packed values unpack to the same bits") {
  const double nan = std::nan("7"), least = std::numeric_limits<double>::denorm_min();
  for (const std::vector<double>& values : std::vector<std::vector<double>>{
           {}, {1}, {1, 1}, {1, 1, 1}, {1, 1, 1, 2}, {0, 1, 1, 1, 1}, {0.0, -0.0, 0.0}, {nan, nan, nan, least}})
    check_round_trip(values);
  std::mt19937 random(7);
  for (int kinds = 1; kinds <= 4; ++kinds)
    for (std::size_t length = 0; length < 60; ++length) {
      std::vector<double> values(length, 0.0);
      for (double& v : values) v = std::uniform_int_distribution<int>(1, kinds)(random);
      check_round_trip(values);
    }
}

TEST_CASE("repeated values take two words, however many") {
  CHECK(PackedValues(std::vector<double>(1000000, 0.25)).words().size() == 2);
}

TEST_CASE("the first packed value that is not finite is found") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(PackedValues{1, 1, 1, 1, inf, 2}.first_not_finite() == 4);
  CHECK(PackedValues{1, 2, inf, inf, inf}.first_not_finite() == 2);
  CHECK(PackedValues{1, 1, 1}.first_not_finite() == 3);
}

TEST_CASE("words that are not packed values are refused") {
  const auto words = PackedValues{1, 1, 1, 2, 3}.words();
  CHECK(PackedValues::from_words(words, 5));
  CHECK_FALSE(PackedValues::from_words(words, 4));                             // more values than allowed
  CHECK_FALSE(PackedValues::from_words({words.begin(), words.end() - 1}, 5));  // the end is missing
  CHECK_FALSE(PackedValues::from_words({0}, 5));                               // a block of nothing
  CHECK_FALSE(PackedValues::from_words({~std::uint64_t(0), 1}, 5));            // a count beyond all bounds
}

}  // namespace packed_values_tests
