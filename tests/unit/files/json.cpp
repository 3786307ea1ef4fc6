// JSON: written in order and exactly, read back at its top level, damaged texts taken for none.
#include "files/json.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

namespace json_tests {
using namespace seiche;

TEST_CASE("JSON is written with its members in order") {
  const JsonMembers inner{{"b", 1}, {"a", JsonValue()}};
  const JsonValue value(JsonMembers{{"z", "a\"\\\n"}, {"list", JsonItems{inner, 2.5, false}}, {"none", JsonItems{}}});
  CHECK(format_json(value) ==
        "{\n  \"z\": \"a\\\"\\\\\\n\",\n  \"list\": [\n    {\n      \"b\": 1,\n      \"a\": null\n    },\n    2.5,\n"
        "    false\n  ],\n  \"none\": []\n}\n");
}

TEST_CASE("numbers of JSON read back as they were, and those that are not finite are null") {
  const double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  for (const double number : {0.0, -0.0, 0.1, 1.0 / 3, -2.0, 123456789012345678.0, 9007199254740993.0, 1e22, 6e-310,
                              largest, -largest, least}) {
    const auto back = json_number(format_json(JsonMembers{{"x", number}}), "x");
    REQUIRE(back);
    CHECK(*back == number);
    CHECK(std::signbit(*back) == std::signbit(number));
  }
  CHECK(format_json(JsonMembers{{"x", 3.0}, {"y", -7}}) == "{\n  \"x\": 3,\n  \"y\": -7\n}\n");
  for (const double number : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    CHECK(format_json(JsonItems{number}) == "[\n  null\n]\n");
  CHECK(format_json(JsonItems{std::optional<double>(), std::optional<double>(0.5)}) == "[\n  null,\n  0.5\n]\n");
}

TEST_CASE("bytes that are no UTF-8 do not break JSON") {
  const std::string text = format_json(JsonMembers{{"name", "caf\xe9.toml"}, {"next", "caf\xc3\xa9"}});
  CHECK(json_value(text, "name") == "caf\xef\xbf\xbd.toml");
  CHECK(json_value(text, "next") == "caf\xc3\xa9");
}

TEST_CASE("values of a JSON object are found at its top level only") {
  const std::string json =
      "{\n  \"a\": {\"b\": 1, \"c\": [2, 3]},\n  \"b\": 4.5e-3,\n  \"c\": \"say \\\"b\\\": 7, ok\", \"e\": null, "
      "\"f\": 12}";
  CHECK(json_value(json, "b") == "0.0045");
  CHECK(json_number(json, "b") == 4.5e-3);
  CHECK(json_value(json, "c") == "say \"b\": 7, ok");
  CHECK_FALSE(json_number(json, "c"));
  CHECK(json_value(json, "e") == "null");
  CHECK(json_value(json, "f") == "12");
  for (const char* key : {"a", "d"}) CHECK(json_value(json, key).empty());
}

TEST_CASE("damaged JSON holds nothing") {
  const std::string whole = format_json(JsonMembers{{"time", 1.5}, {"ended", "finished"}});
  CHECK(is_json_object(whole));
  const std::string deep(100000, '[');
  for (std::size_t cut = 0; cut + 2 < whole.size(); ++cut) {
    CHECK_FALSE(is_json_object(whole.substr(0, cut)));
    CHECK(json_value(whole.substr(0, cut), "time").empty());
  }
  for (const std::string& text :
       {std::string("[1]"), std::string("7"), std::string("{\"time\": 1e999}"), std::string("{\"time\": 1\xff}"),
        std::string("\0\0", 2), deep, "{\"time\":" + deep}) {
    CHECK_FALSE(is_json_object(text));
    CHECK_FALSE(json_number(text, "time"));
  }
  CHECK(json_value("{\"time\":" + deep + std::string(deep.size(), ']') + "}", "time").empty());
}

}  // namespace json_tests
