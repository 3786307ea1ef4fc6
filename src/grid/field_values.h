#pragma once
// The values of a cell field, or of one component of a field on faces or edges.
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <functional>
#include <new>
#include <type_traits>
#include <utility>

#include "grid/field_memory.h"

namespace seiche {

// Calls body(begin, end) for pieces of 0 <= i < count, concurrently: parallel_pieces() without its header.
void in_pieces(std::size_t count, std::size_t piece, const std::function<void(std::size_t, std::size_t)>& body);

// Writes only another value: memory of zeros that nobody has written to is not taken by writing zeros.
template <class T>
void set_if_other(T& at, T value) {
  if (at != value) at = value;
}

// An array that all threads copy and fill. Large arrays of zeros take no memory until values are set.
template <class T>
class FieldValues {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  FieldValues() = default;
  explicit FieldValues(std::size_t size, T value = T{}) : size_(size) {
    const bool zero = is_zero(value);
    if (is_large())
      data_ = static_cast<T*>(zero ? take_zeros(bytes()) : take_for_copy(nullptr, bytes()));
    else
      data_ = small_memory(size);
    if (!zero || !is_large()) fill(value);
  }
  FieldValues(const T* begin, const T* end) : size_(std::size_t(end - begin)) {
    data_ = is_large() ? static_cast<T*>(take_for_copy(begin, bytes())) : small_memory(size_);
    copy(begin);
  }
  FieldValues(const FieldValues& other) : FieldValues(other.begin(), other.end()) {}
  FieldValues(FieldValues&& other) noexcept { swap(other); }
  FieldValues& operator=(const FieldValues& other) {
    if (this == &other) return *this;
    if (size_ != other.size_) return *this = FieldValues(other);
    copy(other.data_);
    return *this;
  }
  FieldValues& operator=(FieldValues&& other) noexcept {
    FieldValues(std::move(other)).swap(*this);
    return *this;
  }
  ~FieldValues() {
    if (is_large())
      give_back(data_, bytes());
    else
      ::operator delete(data_, alignment);
  }

  void assign(std::size_t size, T value) {
    if (size != size_)
      FieldValues(size, value).swap(*this);
    else
      fill(value);
  }
  void fill(T value) {
    in_pieces(size_, a_task, [&](std::size_t b, std::size_t e) { std::fill(data_ + b, data_ + e, value); });
  }
  void swap(FieldValues& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  T& operator[](std::size_t i) {
    assert(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return data_[i];
  }
  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  bool operator==(const FieldValues& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

 private:
  static constexpr std::align_val_t alignment{64};
  static constexpr std::size_t a_task = 65536 / sizeof(T);  // entries that a thread takes at a time

  static bool is_zero(T value) {
    const T zero{};
    return std::memcmp(&value, &zero, sizeof value) == 0;
  }
  static T* small_memory(std::size_t size) {
    return size > 0 ? static_cast<T*>(::operator new(size * sizeof(T), alignment)) : nullptr;
  }
  std::size_t bytes() const { return size_ * sizeof(T); }
  bool is_large() const { return is_large_field(bytes()); }
  void copy(const T* from) {
    if (is_large() && starts_page(from)) return copy_large(from, data_, bytes());
    in_pieces(size_, a_task, [&](std::size_t b, std::size_t e) { std::copy(from + b, from + e, data_ + b); });
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace seiche
