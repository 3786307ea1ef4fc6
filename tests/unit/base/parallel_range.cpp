// Loops in pieces: complete, and with the same bits on any number of threads.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/parallel_range.h"
#include "base/thread_limit.h"

namespace parallel_range_tests {
using namespace seiche;

TEST_CASE("pieces cover a range once, whatever its length") {
  for (const std::size_t count : {0, 1, 6, 7, 8, 700, 701}) {
    std::vector<int> visits(count);
    parallel_pieces(count, 7, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    CHECK(visits == std::vector<int>(count, 1));
  }
}

TEST_CASE("a sum of pieces has the same bits on any number of threads") {
  const auto piece = [](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += std::sin(double(i)) / (1 + double(i));
    return sum;
  };
  const ThreadLimit one(1);
  const double alone = sum_of_pieces(100000, 128, piece);
  for (const int threads : {2, 3, 8}) {
    const ThreadLimit limit(threads);
    CHECK(sum_of_pieces(100000, 128, piece) == alone);
  }
  // The sum of sin(i) / (1 + i) over all i converges like 1 / i; a sum in one piece differs by rounding only.
  CHECK(alone == Approx(piece(0, 100000)).epsilon(1e-12));
}

}  // namespace parallel_range_tests
