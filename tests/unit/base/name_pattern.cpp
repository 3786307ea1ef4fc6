#include "base/name_pattern.h"

#include <catch2/catch.hpp>

namespace name_pattern_tests {
using namespace seiche;

TEST_CASE("patterns of names fit whole names") {
  for (const auto& [name, pattern] : std::vector<std::pair<std::string, std::string>>{{"post-1", "post*"},
                                                                                      {"post", "post*"},
                                                                                      {"gate", "gate"},
                                                                                      {"a-b-c", "a*c"},
                                                                                      {"a-b-c", "*b*"},
                                                                                      {"x", "?"},
                                                                                      {"", "*"},
                                                                                      {"", ""},
                                                                                      {"abab", "*ab"},
                                                                                      {"aab", "a*ab"},
                                                                                      {"[1]", "[1]"},
                                                                                      {"a.b", "a.b"},
                                                                                      {"é", "*"}})
    CHECK(fits(name, pattern));
  for (const auto& [name, pattern] : std::vector<std::pair<std::string, std::string>>{{"post", "post?"},
                                                                                      {"a post", "post*"},
                                                                                      {"gates", "gate"},
                                                                                      {"", "?"},
                                                                                      {"ab", "a"},
                                                                                      {"a", ""},
                                                                                      {"axb", "a.b"}})
    CHECK_FALSE(fits(name, pattern));
  CHECK(fits_any("gate", {"post*", "g?te"}));
  CHECK_FALSE(fits_any("gate", {}));
  const std::string stars(200, '*'), many(200, 'a');
  CHECK_FALSE(fits(many, stars + "b"));  // by at most a product of both lengths
}

}  // namespace name_pattern_tests
