// Base64 against the vectors of RFC 4648, and what its decoder refuses.
#include <catch2/catch.hpp>

#include <random>

#include "base/base64.h"

namespace base64_tests {
using namespace seiche;

TEST_CASE("base64 gives the vectors of RFC 4648, and their bytes back") {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    CHECK(encode_base64(bytes) == text);
    CHECK(decode_base64(text) == bytes);
    CHECK(base64_length(std::string_view(bytes).size()) == std::string_view(text).size());
  }
}

TEST_CASE("base64 keeps any bytes") {
  std::mt19937 random(3);
  for (std::size_t size = 0; size < 70; ++size) {
    std::string bytes;
    for (std::size_t n = 0; n < size; ++n) bytes += char(random());
    CHECK(decode_base64(encode_base64(bytes)) == bytes);
  }
  CHECK(encode_base64("\xfb\xff\xbf") == "+/+/");
}

TEST_CASE("texts that are no base64 are refused") {
  for (const char* text : {"Z", "Zg", "Zg=", "Zm9", "====", "Z===", "=Zg=", "Zg==Zg==", "Zm8=Zm8=", "Zm9v\n", "Zm 9",
                           "Zm9-", "Zm9_", "Zm9\xff", "Zh==", "Zm9=", "Zm9vY"}) {
    INFO(text);
    CHECK_FALSE(decode_base64(text));
  }
}

}  // namespace base64_tests
