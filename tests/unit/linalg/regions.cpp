// Ranges of cells around bodies: periodic axes, rows without a cell.
#include <catch2/catch.hpp>

#include "linalg/spd/body_regions.h"
#include "unit/linalg/cases.h"

namespace regions_tests {
using namespace seiche;

TEST_CASE("ranges of cells go on beyond periodic sides") {
  const CellRange high{{7, 2, 0}, {12, 5, 1}, {10, 0, 0}};  // 7, 8, 9, 0, 1 along x
  CHECK(high.contains({9, 3, 0}));
  CHECK(high.contains({1, 3, 0}));
  CHECK(!high.contains({2, 3, 0}));
  CHECK(!high.contains({8, 5, 0}));
  const CellRange low{{0, 2, 0}, {2, 5, 1}, {10, 0, 0}}, middle{{3, 2, 0}, {6, 5, 1}, {10, 0, 0}};
  CHECK(high.meets(low));
  CHECK(low.meets(high));
  CHECK(!high.meets(middle));
  CHECK(!middle.meets(high));
  CHECK(!low.meets(middle));
  CHECK(high.offset(0, 0) == 3);
  const CellRange all = middle.grown(4);
  CHECK(all.wraps(0));
  CHECK(!all.wraps(1));
  CHECK(all.meets(low));
  CHECK(color({high, low, middle}, {0, 0, 0}) == std::vector<int>{0, 1, 0});
  CHECK(color({high, low, middle}, {1, 0, 1}) == std::vector<int>{0, 1, 1});
  CHECK(high.squared_distance(low) == 0);
  CHECK(high.squared_distance(middle) == 1);  // 6 lies between
  CHECK(low.squared_distance({{4, 7, 3}, {5, 8, 4}, {10, 0, 0}}) == 2 * 2 + 2 * 2 + 2 * 2);
  CHECK(color({high, low, middle}, {0, 0, 0}, 1) == std::vector<int>{0, 1, 0});
  CHECK(color({high, low, middle}, {0, 0, 0}, 2) == std::vector<int>{0, 1, 2});
}

TEST_CASE("no range without period goes on beyond a side") {
  const CellRange range{{7, 2, 0}, {12, 5, 1}};
  CHECK(range.contains({11, 3, 0}));
  CHECK(!range.contains({1, 3, 0}));
  CHECK(!range.contains({6, 3, 0}));
  CHECK(!range.meets({{0, 2, 0}, {2, 5, 1}}));
  CHECK(range.meets({{11, 4, 0}, {20, 9, 1}}));
}

}  // namespace regions_tests
