#pragma once
// Memory of fields, kept for the next field of its size. A step makes and drops hundreds of fields of a few sizes;
// fresh pages from the system must each be cleared by it, which took up to half of a step's processor time.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace seiche {

// At least `bytes` of memory aligned to a cache line, from a dropped block of the same size class if there is one.
// Throws std::bad_alloc. Thread-safe.
void* take_block(std::size_t bytes);
// Keeps a block of take_block(bytes) for later.
void give_block(void* block, std::size_t bytes) noexcept;

struct BlockCounts {
  std::int64_t fresh = 0;         // blocks that came from the system so far
  std::size_t bytes_in_use = 0;   // of blocks taken and not given back
  std::size_t bytes_waiting = 0;  // of blocks kept for later
};
BlockCounts block_counts();

// Returns the waiting blocks to the system.
void release_waiting_blocks();

template <class T>
struct RecyclingAllocator {
  using value_type = T;
  RecyclingAllocator() = default;
  template <class U>
  RecyclingAllocator(const RecyclingAllocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t n) { return static_cast<T*>(take_block(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) noexcept { give_block(p, n * sizeof(T)); }
  friend bool operator==(const RecyclingAllocator&, const RecyclingAllocator&) { return true; }
};

// The values of one component of a field.
template <class T>
using FieldValues = std::vector<T, RecyclingAllocator<T>>;

}  // namespace seiche
