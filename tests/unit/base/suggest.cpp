#include "base/suggest.h"

#include <catch2/catch.hpp>

namespace suggest_tests {
using namespace seiche;

TEST_CASE("edit distance counts insertions, deletions, substitutions and swaps") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);  // a standard example
  CHECK(edit_distance("densty", "density") == 1);
  CHECK(edit_distance("shpae", "shape") == 1);
}

TEST_CASE("edit distance is symmetric") {
  const std::vector<std::string> words{"radius", "raduis", "center", "centre", "lower", "upper", "x", ""};
  for (const auto& a : words) {
    for (const auto& b : words) CHECK(edit_distance(a, b) == edit_distance(b, a));
  }
}

TEST_CASE("only slips are suggested") {
  const std::vector<std::string> keys{"density", "velocity", "region", "to"};
  CHECK(suggest("densty", keys) == "density");
  CHECK(suggest("velocty", keys) == "velocity");
  CHECK(!suggest("colour", keys));
  CHECK(!suggest("zz", keys));
  CHECK(!suggest(std::string(1000, 'd'), keys));
}

TEST_CASE("of names equally near the one that begins alike is suggested") {
  CHECK(suggest("sinn", {"sign", "sin", "sinh"}) == "sin");
  CHECK(suggest("coss", {"cosh", "cos"}) == "cosh");
  CHECK(suggest("poins", {"point", "points"}) == "points");
}

}  // namespace suggest_tests
