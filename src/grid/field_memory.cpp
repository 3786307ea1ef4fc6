#include "grid/field_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <vector>

#include "base/parallel_range.h"

namespace seiche {
namespace {

// Bytes. For less, a mapping of its own costs more than it saves. AddressSanitizer sees the ends of other memory alone.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t large = ~std::size_t(0);
#else
constexpr std::size_t large = std::size_t(1) << 20;
#endif
constexpr std::size_t page = 4096;

std::size_t page_count(std::size_t bytes) {
  return (bytes + page - 1) / page;
}

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

std::atomic<std::size_t> mapped{0};

void* map_memory(std::size_t bytes) {
  ++mapped;
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

// The kernel's entries of this process, or -1: not there, or of pages of another size.
int open_pagemap() {
  return ::sysconf(_SC_PAGESIZE) == long(page) ? ::open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC) : -1;
}

// The kernel's entry for each page of an array (Linux, admin-guide/mm/pagemap). All bits are set where it does not
// tell.
std::vector<std::uint64_t> page_entries(const void* memory, std::size_t bytes) {
  static const int pagemap = open_pagemap();
  std::vector<std::uint64_t> entries(page_count(bytes));
  const std::size_t size = entries.size() * sizeof(entries[0]);
  const auto from = off_t(reinterpret_cast<std::uintptr_t>(memory) / page * sizeof(entries[0]));
  if (pagemap < 0 || ::pread(pagemap, entries.data(), size, from) != ssize_t(size))
    std::fill(entries.begin(), entries.end(), ~std::uint64_t(0));
  return entries;
}

// True if nobody has touched the page: it is zero for certain.
bool is_untouched(std::uint64_t entry) {
  constexpr std::uint64_t present = std::uint64_t(1) << 63, swapped = std::uint64_t(1) << 62;
  return (entry & (present | swapped)) == 0;
}

// True if hardly any page is empty. Reading an untouched page maps a page of zeros, which is not mapped exclusively. A
// guess is enough: it decides which memory is used again, not what it holds.
bool is_dense(const void* memory, std::size_t bytes) {
  constexpr std::uint64_t exclusive = std::uint64_t(1) << 56;
  const std::vector<std::uint64_t> entries = page_entries(memory, bytes);
  const auto in_use = std::count_if(entries.begin(), entries.end(), [](std::uint64_t e) { return e & exclusive; });
  return 5 * std::size_t(in_use) > 4 * entries.size();
}

constexpr std::size_t pages_a_piece = 128;

// The kernel's entries for pages begin to end of an array.
std::vector<std::uint64_t> entries_of(const void* memory, std::size_t bytes, std::size_t begin, std::size_t end) {
  return page_entries(static_cast<const char*>(memory) + begin * page, std::min(bytes, end * page) - begin * page);
}

// Gives back to the system the pages of runs that end where add() is not called for the next page.
class PagesToGiveBack {
 public:
  explicit PagesToGiveBack(char* memory) : memory_(memory) {}
  PagesToGiveBack(const PagesToGiveBack&) = delete;
  ~PagesToGiveBack() { flush(); }
  void add(std::size_t n) {
    if (n != end_) flush(), begin_ = n;
    end_ = n + 1;
  }

 private:
  // Each call interrupts all threads of the process.
  void flush() const {
    if (begin_ < end_) ::madvise(memory_ + begin_ * page, (end_ - begin_) * page, MADV_DONTNEED);
  }

  char* memory_;
  std::size_t begin_ = 0, end_ = 0;
};

// `drop`: gives pages back to the system that are zero already.
void make_zero(void* memory, std::size_t bytes, bool drop) {
  parallel_pieces(page_count(bytes), pages_a_piece, [&](std::size_t begin, std::size_t end) {
    const std::vector<std::uint64_t> entries = entries_of(memory, bytes, begin, end);
    PagesToGiveBack drops(static_cast<char*>(memory));
    for (std::size_t n = begin; n < end; ++n) {
      if (is_untouched(entries[n - begin])) continue;
      char* at = static_cast<char*>(memory) + n * page;
      const std::size_t count = std::min(page, bytes - n * page);
      if (!is_zero_page(at, count))
        std::memset(at, 0, count);
      else if (drop)
        drops.add(n);
    }
  });
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
    return ++taken_ % 64 == 0;
  }

 private:
  static constexpr std::size_t most_dense = 12, most_sparse = 96;

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

bool starts_page(const void* memory) {
  return reinterpret_cast<std::uintptr_t>(memory) % page == 0;
}

std::size_t large_fields_mapped() {
  return mapped;
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

void copy_large(const void* from, void* to, std::size_t bytes) {
  parallel_pieces(page_count(bytes), pages_a_piece, [&](std::size_t begin, std::size_t end) {
    const std::vector<std::uint64_t> of_source = entries_of(from, bytes, begin, end),
                                     of_target = entries_of(to, bytes, begin, end);
    for (std::size_t n = begin; n < end; ++n) {
      const std::size_t count = std::min(page, bytes - n * page);
      const char* source = static_cast<const char*>(from) + n * page;
      char* target = static_cast<char*>(to) + n * page;
      if (!is_untouched(of_source[n - begin]) && !is_zero_page(source, count))
        std::memcpy(target, source, count);
      else if (!is_untouched(of_target[n - begin]) && !is_zero_page(target, count))
        std::memset(target, 0, count);
    }
  });
}

}  // namespace seiche
