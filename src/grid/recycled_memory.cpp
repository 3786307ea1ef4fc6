#include "grid/recycled_memory.h"

#include <sys/mman.h>

#include <map>
#include <mutex>
#include <new>

namespace seiche {
namespace {

constexpr std::size_t line = 64, page = 4096, huge_page = std::size_t(2) << 20;
constexpr std::size_t smallest = 16 * page;  // smaller blocks are left to the heap

// Large blocks are whole huge pages, so that clearing and address translation cost little.
std::size_t size_class(std::size_t bytes) {
  const std::size_t unit = bytes >= huge_page ? huge_page : page;
  return (bytes + unit - 1) / unit * unit;
}

void* map_pages(std::size_t bytes) {
  void* block = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) return nullptr;
  if (bytes >= huge_page) madvise(block, bytes, MADV_HUGEPAGE);  // a hint: kernels without huge pages refuse it
  return block;
}

class BlockPool {
 public:
  void* take(std::size_t bytes) {
    const std::size_t size = size_class(bytes);
    const std::lock_guard guard(mutex_);
    std::vector<void*>& waiting = waiting_[size];
    void* block = nullptr;
    if (!waiting.empty()) {
      block = waiting.back();
      waiting.pop_back();
      counts_.bytes_waiting -= size;
    } else if (block = fresh(size); !block) {
      throw std::bad_alloc();
    }
    counts_.bytes_in_use += size;
    return block;
  }

  void give(void* block, std::size_t bytes) noexcept {
    const std::size_t size = size_class(bytes);
    const std::lock_guard guard(mutex_);
    counts_.bytes_in_use -= size;
    try {
      waiting_[size].push_back(block);
      counts_.bytes_waiting += size;
    } catch (const std::bad_alloc&) {
      munmap(block, size);
    }
  }

  void release() {
    const std::lock_guard guard(mutex_);
    drop_waiting();
  }

  BlockCounts counts() {
    const std::lock_guard guard(mutex_);
    return counts_;
  }

 private:
  // Where the system has no more, blocks of other sizes go back to it first.
  void* fresh(std::size_t size) {
    ++counts_.fresh;
    void* block = map_pages(size);
    if (block) return block;
    drop_waiting();
    return map_pages(size);
  }

  void drop_waiting() {
    for (auto& [size, blocks] : waiting_) {
      for (void* block : blocks) munmap(block, size);
      blocks.clear();
    }
    counts_.bytes_waiting = 0;
  }

  std::mutex mutex_;
  std::map<std::size_t, std::vector<void*>> waiting_;  // by size class
  BlockCounts counts_;
};

// Never destroyed: fields of static storage may outlive any other static object.
BlockPool& pool() {
  static BlockPool* const instance = new BlockPool;
  return *instance;
}

}  // namespace

void* take_block(std::size_t bytes) {
  if (bytes < smallest) return ::operator new(bytes, std::align_val_t(line));
  return pool().take(bytes);
}

void give_block(void* block, std::size_t bytes) noexcept {
  if (bytes < smallest) return ::operator delete(block, std::align_val_t(line));
  pool().give(block, bytes);
}

BlockCounts block_counts() {
  return pool().counts();
}

void release_waiting_blocks() {
  pool().release();
}

}  // namespace seiche
