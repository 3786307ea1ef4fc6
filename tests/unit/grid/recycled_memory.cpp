#include "grid/recycled_memory.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <thread>

#include "grid/fields.h"

using namespace seiche;

namespace {

constexpr std::size_t large = std::size_t(3) << 20;

}  // namespace

TEST_CASE("a dropped block serves the next one of its size") {
  release_waiting_blocks();
  void* const first = take_block(large);
  give_block(first, large);
  const BlockCounts before = block_counts();
  CHECK(before.bytes_waiting >= large);
  void* const second = take_block(large - 8);  // of the same size class
  CHECK(second == first);
  CHECK(block_counts().fresh == before.fresh);
  give_block(second, large - 8);
  release_waiting_blocks();
  CHECK(block_counts().bytes_waiting == 0);
}

TEST_CASE("blocks are aligned to cache lines, small ones too") {
  for (const std::size_t bytes : {std::size_t(1), std::size_t(100), std::size_t(1) << 17, large}) {
    void* const block = take_block(bytes);
    CHECK(reinterpret_cast<std::uintptr_t>(block) % 64 == 0);
    give_block(block, bytes);
  }
}

TEST_CASE("copies and moves of fields are values, whatever memory they get") {
  FieldValues<double> a(1 << 20, 1.0), b = a;
  b[7] = 2;
  CHECK(a[7] == 1);
  FieldValues<double> c = std::move(b);
  CHECK(c[7] == 2);
  a = c;
  CHECK(a[7] == 2);
  FieldValues<double>().swap(c);
  const FieldValues<double> fresh(1 << 20, 0.0);  // takes a block that held other values
  CHECK(std::all_of(fresh.begin(), fresh.end(), [](double x) { return x == 0; }));
}

TEST_CASE("threads take and give blocks at the same time") {
  const auto work = [] {
    for (int n = 0; n < 200; ++n) {
      FieldValues<char> values(large + std::size_t(n % 3) * large, char(n));
      REQUIRE(values.back() == char(n));
    }
  };
  std::thread other(work);
  work();
  other.join();
}

TEST_CASE("more memory than there is throws") {
  CHECK_THROWS_AS(take_block(std::size_t(1) << 60), std::bad_alloc);
}
