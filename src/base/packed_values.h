#pragma once
// Doubles in sequence, bit for bit. A value that is repeated takes no room.
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace seiche {

// Stored as blocks of 64-bit words: a head of 2 n for n different values, which follow, or 2 n + 1 for n copies of the
// one that follows.
class PackedValues {
 public:
  PackedValues() = default;
  PackedValues(std::initializer_list<double> values);
  explicit PackedValues(const std::vector<double>& values);
  // Nothing if the words do not form blocks, or if they hold more than `most` values.
  static std::optional<PackedValues> from_words(std::vector<std::uint64_t> words, std::uint64_t most);

  void push_back(double value);
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::vector<double> unpack() const;
  // Number of the first value that is not finite, or size().
  std::size_t first_not_finite() const;
  const std::vector<std::uint64_t>& words() const { return words_; }

  friend bool operator==(const PackedValues&, const PackedValues&) = default;  // of bits

 private:
  bool repeats() const { return words_[head_] % 2 == 1; }
  bool ends_with_two(std::uint64_t bits) const;
  void open(std::uint64_t kind, std::uint64_t count, std::uint64_t bits);

  std::vector<std::uint64_t> words_;
  std::size_t head_ = 0, size_ = 0;  // of the last block; number of values
};

}  // namespace seiche
