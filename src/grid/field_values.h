#pragma once
// The values of a cell field, or of one component of a field on faces or edges.
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <functional>
#include <new>
#include <type_traits>
#include <utility>

namespace seiche {

// Calls body(begin, end) for pieces of 0 <= i < count, concurrently: parallel_pieces() without its header.
void in_pieces(std::size_t count, std::size_t piece, const std::function<void(std::size_t, std::size_t)>& body);

// An array that all threads copy and fill: fields are large, and much of a step's time goes to fresh memory.
template <class T>
class FieldValues {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  FieldValues() = default;
  explicit FieldValues(std::size_t size, T value = T{}) : FieldValues(size, Raw{}) { fill(value); }
  FieldValues(const T* begin, const T* end) : FieldValues(std::size_t(end - begin), Raw{}) { copy(begin); }
  FieldValues(const FieldValues& other) : FieldValues(other.size_, Raw{}) { copy(other.data_); }
  FieldValues(FieldValues&& other) noexcept { swap(other); }
  FieldValues& operator=(const FieldValues& other) {
    if (this == &other) return *this;
    if (size_ != other.size_) FieldValues(other.size_, Raw{}).swap(*this);
    copy(other.data_);
    return *this;
  }
  FieldValues& operator=(FieldValues&& other) noexcept {
    FieldValues(std::move(other)).swap(*this);
    return *this;
  }
  ~FieldValues() { ::operator delete(data_, alignment); }

  void assign(std::size_t size, T value) {
    if (size != size_) FieldValues(size, Raw{}).swap(*this);
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
  struct Raw {};
  static constexpr std::align_val_t alignment{64};
  static constexpr std::size_t a_task = 65536 / sizeof(T);  // entries that a thread takes at a time
  static T* memory_for(std::size_t size) {
    return size > 0 ? static_cast<T*>(::operator new(size * sizeof(T), alignment)) : nullptr;
  }
  FieldValues(std::size_t size, Raw) : data_(memory_for(size)), size_(size) {}
  void copy(const T* from) {
    in_pieces(size_, a_task, [&](std::size_t b, std::size_t e) { std::copy(from + b, from + e, data_ + b); });
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace seiche
