#include "base/packed_values.h"

#include <bit>
#include <cmath>

namespace seiche {
namespace {

constexpr std::uint64_t different = 0, repeated = 1;  // kinds of blocks

std::uint64_t head_of(std::uint64_t kind, std::uint64_t count) {
  return 2 * count + kind;
}

std::uint64_t stored_words(std::uint64_t head) {
  return head % 2 == repeated ? 1 : head / 2;
}

}  // namespace

PackedValues::PackedValues(std::initializer_list<double> values) {
  for (const double v : values) push_back(v);
}

PackedValues::PackedValues(const std::vector<double>& values) {
  for (const double v : values) push_back(v);
}

std::optional<PackedValues> PackedValues::from_words(std::vector<std::uint64_t> words, std::uint64_t most) {
  PackedValues packed;
  for (std::size_t at = 0; at < words.size();) {
    const std::uint64_t head = words[at], left = words.size() - at - 1;
    if (head / 2 == 0 || head / 2 > most - packed.size_ || stored_words(head) > left) return std::nullopt;
    packed.head_ = at;
    packed.size_ += std::size_t(head / 2);
    at += 1 + std::size_t(stored_words(head));
  }
  packed.words_ = std::move(words);
  return packed;
}

// Three equal values in sequence begin a block of copies: two cost as much as a block.
void PackedValues::push_back(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  ++size_;
  if (words_.empty()) return open(different, 1, bits);
  if (repeats()) {
    if (words_.back() == bits)
      words_[head_] += 2;
    else
      open(different, 1, bits);
  } else if (ends_with_two(bits)) {
    words_.resize(words_.size() - 2);
    words_[head_] -= 4;
    if (words_[head_] == head_of(different, 0)) words_.pop_back();
    open(repeated, 3, bits);
  } else {
    words_.push_back(bits);
    words_[head_] += 2;
  }
}

bool PackedValues::ends_with_two(std::uint64_t bits) const {
  return words_[head_] / 2 >= 2 && words_.back() == bits && words_[words_.size() - 2] == bits;
}

void PackedValues::open(std::uint64_t kind, std::uint64_t count, std::uint64_t bits) {
  head_ = words_.size();
  words_.push_back(head_of(kind, count));
  words_.push_back(bits);
}

std::vector<double> PackedValues::unpack() const {
  std::vector<double> values;
  values.reserve(size_);
  for (std::size_t at = 0; at < words_.size(); at += 1 + std::size_t(stored_words(words_[at]))) {
    const std::size_t count = std::size_t(words_[at] / 2);
    if (words_[at] % 2 == repeated)
      values.insert(values.end(), count, std::bit_cast<double>(words_[at + 1]));
    else
      for (std::size_t n = 1; n <= count; ++n) values.push_back(std::bit_cast<double>(words_[at + n]));
  }
  return values;
}

std::size_t PackedValues::first_not_finite() const {
  std::size_t before = 0;
  for (std::size_t at = 0; at < words_.size(); at += 1 + std::size_t(stored_words(words_[at]))) {
    for (std::size_t n = 0; n < stored_words(words_[at]); ++n)
      if (!std::isfinite(std::bit_cast<double>(words_[at + 1 + n]))) return before + n;
    before += std::size_t(words_[at] / 2);
  }
  return size_;
}

}  // namespace seiche
