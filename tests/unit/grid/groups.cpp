// Tests of eight values at once, and loops that skip where they fail.
#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "grid/fields.h"
#include "grid/loops.h"

namespace groups_tests {
using namespace seiche;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

std::array<double, a_group> group_with(double usual, double other, int at) {
  std::array<double, a_group> f;
  f.fill(usual);
  f[std::size_t(at)] = other;
  return f;
}

}  // namespace

TEST_CASE("a group of doubles is told by any of its values") {
  for (int at = 0; at < a_group; ++at) {
    CHECK(any_negative(group_with(1, -1e-300, at).data()));
    CHECK_FALSE(all_zero(group_with(0, 5e-324, at).data()));
    CHECK_FALSE(all_zero(group_with(0, no_number, at).data()));
    CHECK_FALSE(all_above(group_with(2, 1, at).data(), 1));
    CHECK_FALSE(all_above(group_with(2, no_number, at).data(), 1));
    CHECK(any_within(group_with(2, -0.5, at).data(), 1));
    CHECK_FALSE(all_finite(group_with(0, endless, at).data()));
    CHECK_FALSE(all_finite(group_with(0, no_number, at).data()));
  }
  CHECK_FALSE(any_negative(group_with(0, endless, 3).data()));
  CHECK(all_zero(group_with(0, -0.0, 3).data()));
  CHECK(all_above(group_with(2, endless, 3).data(), 1));
  CHECK_FALSE(any_within(group_with(2, no_number, 3).data(), 1));
  CHECK(all_finite(group_with(1e308, -1e308, 3).data()));
}

TEST_CASE("a group of marks is told by any of them") {
  for (int at = 0; at < a_group; ++at) {
    std::array<char, a_group> none{}, one{}, all_but_one;
    one[std::size_t(at)] = 4;
    all_but_one.fill(char(-1));
    all_but_one[std::size_t(at)] = 0;
    CHECK_FALSE(any_marked(none.data()));
    CHECK_FALSE(all_marked(none.data()));
    CHECK(any_marked(one.data()));
    CHECK_FALSE(all_marked(one.data()));
    CHECK_FALSE(all_marked(all_but_one.data()));
    all_but_one[std::size_t(at)] = 1;
    CHECK(all_marked(all_but_one.data()));
  }
}

// Rows of 1 to 19 sites: the rest of a row that is no whole group is visited in any case.
TEST_CASE("loops over possible sites meet every site that matters") {
  for (int length = 1; length < 20; ++length) {
    Geometry<2> geometry;
    geometry.cells = {length, 3};
    const Layout<2> layout(geometry, geometry.box(), 2);
    CellField<2, char> marks(layout);
    std::set<Site> marked;
    for_each_index_in_order(layout, layout.cells(), [&](Site s, const IVec<2>& i) {
      if ((i[0] * 7 + i[1] * 5) % 11 != 0) return;
      marks[s] = 1;
      marked.insert(s);
    });
    const auto may_matter = [&](Site s) { return any_marked(marks.data() + s); };
    const auto is_marked = [&](Site s) { return marks[s] != 0; };
    std::set<Site> visited;
    for_each_possible(layout, layout.cells(), may_matter, [&](Site s) {
      if (is_marked(s)) visited.insert(s);
    });
    CHECK(visited == marked);
    const std::vector<Site> listed = listed_possible(layout, layout.cells(), may_matter, is_marked);
    CHECK(std::set<Site>(listed.begin(), listed.end()) == marked);
    CHECK(local_sum_of_possible(layout, layout.cells(), may_matter, [&](Site s) { return int(marks[s]); }) ==
          int(marked.size()));
    CHECK(local_max_of_possible(layout, layout.cells(), -1, may_matter, [&](Site s) { return double(s); }) >=
          double(*marked.rbegin()));
    int skipped = 0;
    for_each_possible(
        layout, layout.cells(), [](Site) { return false; }, [&](Site) { ++skipped; });
    CHECK(skipped == 3 * (length % a_group));
  }
}

}  // namespace groups_tests
