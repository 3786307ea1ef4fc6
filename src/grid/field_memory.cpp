#include "grid/field_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <vector>

namespace seiche {
namespace {

// Bytes. For less, a mapping of its own costs more than it saves. AddressSanitizer sees the ends of other memory alone.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t large = ~std::size_t(0);
#else
constexpr std::size_t large = std::size_t(1) << 20;
#endif
constexpr std::size_t page = 4096;

bool is_zero(const char* bytes, std::size_t count) {
  std::uint64_t any = 0, word = 0;
  std::size_t n = 0;
  for (; n + sizeof word <= count; n += sizeof word) {
    std::memcpy(&word, bytes + n, sizeof word);
    any |= word;
  }
  for (; n < count; ++n) any |= std::uint64_t(bytes[n] != 0);
  return any == 0;
}

// Most pages that are not zero show it in their first bytes.
bool is_zero_page(const char* bytes, std::size_t count) {
  return is_zero(bytes, std::min<std::size_t>(count, 64)) && is_zero(bytes, count);
}

void* map_memory(std::size_t bytes) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

// For each page of an array: true if it may be other than zero.
std::vector<unsigned char> pages_in_memory(const void* memory, std::size_t bytes) {
  std::vector<unsigned char> in_memory((bytes + page - 1) / page);
  if (::mincore(const_cast<void*>(memory), bytes, in_memory.data()) != 0)
    std::fill(in_memory.begin(), in_memory.end(), 1);
  for (unsigned char& p : in_memory) p &= 1;
  return in_memory;
}

bool is_dense(const void* memory, std::size_t bytes) {
  const std::vector<unsigned char> in_memory = pages_in_memory(memory, bytes);
  return 2 * std::size_t(std::count(in_memory.begin(), in_memory.end(), 1)) > in_memory.size();
}

// `drop`: gives pages back to the system that are zero already.
void make_zero(void* memory, std::size_t bytes, bool drop) {
  const std::vector<unsigned char> in_memory = pages_in_memory(memory, bytes);
  for (std::size_t n = 0; n < in_memory.size(); ++n) {
    if (!in_memory[n]) continue;
    char* at = static_cast<char*>(memory) + n * page;
    const std::size_t count = std::min(page, bytes - n * page);
    if (!is_zero_page(at, count))
      std::memset(at, 0, count);
    else if (drop)
      ::madvise(at, count, MADV_DONTNEED);
  }
}

// Unused memory by size. Arrays that are mostly zero are kept apart from the others, so that their empty pages last.
class Pool {
 public:
  void* take(std::size_t bytes, bool dense) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      std::vector<void*>& kept = kept_[{bytes, dense}];
      if (!kept.empty()) {
        void* memory = kept.back();
        kept.pop_back();
        return memory;
      }
    }
    if (void* memory = map_memory(bytes)) return memory;
    drop_all();
    if (void* memory = map_memory(bytes)) return memory;
    throw std::bad_alloc();
  }
  void give(void* memory, std::size_t bytes, bool dense) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<void*>& kept = kept_[{bytes, dense}];
    if (kept.size() < (dense ? most_dense : most_sparse))
      kept.push_back(memory);
    else
      ::munmap(memory, bytes);
  }
  // True now and then: pages that arrays no longer use are then looked for.
  bool drops_pages() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ++taken_ % 16 == 0;
  }

 private:
  static constexpr std::size_t most_dense = 8, most_sparse = 64;

  void drop_all() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto& [kind, kept] : kept_)
      for (void* memory : kept) ::munmap(memory, kind.first);
    kept_.clear();
  }

  std::mutex mutex_;
  std::map<std::pair<std::size_t, bool>, std::vector<void*>> kept_;  // by bytes and whether dense
  unsigned taken_ = 0;
};

// Never destroyed: fields of static storage may be given back last.
Pool& pool() {
  static Pool& instance = *new Pool;
  return instance;
}

}  // namespace

bool is_large_field(std::size_t bytes) {
  return bytes >= large;
}

void* take_zeros(std::size_t bytes) {
  void* memory = pool().take(bytes, false);
  make_zero(memory, bytes, pool().drops_pages());
  return memory;
}

void* take_for_copy(const void* source, std::size_t bytes) {
  return pool().take(bytes, source == nullptr || is_dense(source, bytes));
}

void give_back(void* memory, std::size_t bytes) {
  if (memory != nullptr) pool().give(memory, bytes, is_dense(memory, bytes));
}

void copy_field_memory(const void* from, void* to, std::size_t bytes) {
  const char* source = static_cast<const char*>(from);
  char* target = static_cast<char*>(to);
  for (std::size_t n = 0; n < bytes; n += page) {
    const std::size_t count = std::min(page, bytes - n);
    if (!is_zero_page(source + n, count))
      std::memcpy(target + n, source + n, count);
    else if (!is_zero_page(target + n, count))
      std::memset(target + n, 0, count);
  }
}

}  // namespace seiche
