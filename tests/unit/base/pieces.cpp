// Exact properties of the small pieces of base: checksums, sets, ranges, vectors, gravity, agreement.
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "base/agree.h"
#include "base/crc32c.h"
#include "base/disjoint_sets.h"
#include "base/error.h"
#include "base/expression_names.h"
#include "base/gravity.h"
#include "base/options.h"
#include "base/timers.h"
#include "base/vec.h"

namespace pieces_tests {
using namespace seiche;

TEST_CASE("CRC-32C has the values of RFC 3720, B.4") {
  CHECK(crc32c(std::string(32, '\0')) == 0x8a9136aau);
  CHECK(crc32c(std::string(32, '\xff')) == 0x62a8ab43u);
  std::string rising;
  for (char c = 0; c < 32; ++c) rising += c;
  CHECK(crc32c(rising) == 0x46dd794eu);
  CHECK(crc32c("123456789") == 0xe3069283u);
  CHECK(crc32c("") == 0);
}

TEST_CASE("a checksum continues from that of the preceding bytes, at any cut") {
  const std::string text = "the checksum of a text in two parts";
  for (std::size_t cut = 0; cut <= text.size(); ++cut)
    CHECK(crc32c(text.substr(cut), crc32c(text.substr(0, cut))) == crc32c(text));
}

TEST_CASE("a change of any one bit changes the checksum") {
  const std::string text = "seiche";
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string changed = text;
    changed[bit / 8] = char(changed[bit / 8] ^ (1 << bit % 8));
    CHECK(crc32c(changed) != crc32c(text));
  }
}

TEST_CASE("the root of a joined set is its smallest member, in whatever order sets are joined") {
  constexpr int n = 60, step = 7;  // i and i + 7 are joined: seven sets, by the remainder
  std::vector<int> order;
  for (int i = 0; i + step < n; ++i) order.push_back(i);
  std::mt19937 random(1);
  for (int attempt = 0; attempt < 5; ++attempt) {
    std::shuffle(order.begin(), order.end(), random);
    DisjointSets sets(n);
    for (int i = 0; i < n; ++i) CHECK(sets.root(i) == i);
    for (const int i : order) sets.join(i + step, i);
    for (int i = 0; i < n; ++i) CHECK(sets.root(i) == i % step);
  }
}

TEST_CASE("a range contains its included bounds only, and says so") {
  CHECK(contains(positive(8), 8));
  CHECK_FALSE(contains(positive(8), 0));
  CHECK(contains(positive(8), std::numeric_limits<double>::min()));
  CHECK_FALSE(contains(positive(8), std::nextafter(8.0, 9.0)));
  CHECK(describe(positive(8)) == "> 0 and <= 8");
  CHECK(contains(between(-1, 1), -1));
  CHECK_FALSE(contains(between(-1, 1), std::nextafter(1.0, 2.0)));
  CHECK(describe(between(-1, 1)) == ">= -1 and <= 1");
  CHECK(describe(any_number()).empty());
  CHECK(contains(any_number(), -number_limit));
}

TEST_CASE("no range contains what is not a number") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const Range& range : {any_number(), positive(), between(-1, 1)}) {
    CHECK_FALSE(contains(range, nan));
    CHECK_FALSE(contains(range, infinite));
    CHECK_FALSE(contains(range, -infinite));
  }
}

TEST_CASE("a list of names reads as a sentence") {
  CHECK(quoted_list({"a"}) == "\"a\"");
  CHECK(quoted_list({"a", "b"}) == "\"a\" or \"b\"");
  CHECK(quoted_list({"a", "b", "c"}) == "\"a\", \"b\" or \"c\"");
}

TEST_CASE("a vector of either dimension comes back from three dimensions") {
  CHECK(truncate<2>(extend<2>({1, 2})) == Vec<2>(1, 2));
  CHECK(truncate<3>(extend<3>({1, 2, 3})) == Vec3(1, 2, 3));
  CHECK(extend<2>({1, 2}) == Vec3(1, 2, 0));
}

TEST_CASE("gravity given by numbers keeps them bit for bit, at all times") {
  const Vec3 g(0.1, -9.80665, 1.0 / 3);
  const Gravity gravity(GravitySpec(g[0], g[1], g[2]));
  for (const double t : {0.0, 0.3, 1e6}) {
    CHECK(gravity.at(t) == g);
    CHECK(gravity.of_step(t, 0.01) == g);
  }
  CHECK(gravity.largest(0, 5) == g.norm());
  CHECK(gravity.fault(0).empty());
}

// The middle of the step integrates a linear function exactly.
TEST_CASE("gravity of consecutive steps adds up to the integral of gravity linear in time") {
  GravitySpec spec(0, 0, 0);
  spec.formula[1] = "2 - 8*t";
  const Gravity gravity(spec);
  double t = 0, velocity = 0;
  for (const double dt : {0.25, 0.125, 0.5, 0.0625}) {  // exact in binary
    t += dt;
    velocity += dt * gravity.of_step(t, dt)[1];
  }
  CHECK(velocity == 2 * t - 4 * t * t);
  CHECK(gravity.largest(0, 1) == 6);
}

TEST_CASE("gravity that is not finite is reported with its axis and time, and left out of the largest") {
  GravitySpec spec(0, 0, 0);
  spec.formula[2] = "1/(t-2)";
  const Gravity gravity(spec);
  CHECK(gravity.fault(1).empty());
  CHECK(gravity.fault(2) == "gravity[2] = \"1/(t-2)\" is infinite at t = 2 s; it must be a finite number there");
  CHECK(gravity.largest(1, 2) == Approx(1000).epsilon(1e-9));  // at the last sample before 2 s
}

TEST_CASE("names of an expression come in its order, and the e of an exponent is none") {
  const auto names = names_in("1e-3*x + sin(2*pi*t)");
  REQUIRE(names.size() == 4);
  const std::vector<std::string> expected{"x", "sin", "pi", "t"};
  for (std::size_t n = 0; n < names.size(); ++n) {
    CHECK(names[n].name == expected[n]);
    CHECK(names[n].called == (expected[n] == "sin"));
  }
}

TEST_CASE("an error keeps its code and message, and foreign ones get a code of their own") {
  const Communicator ranks;
  const auto code_of = [&](const std::function<void()>& work, const std::string& message) {
    try {
      agree(ranks, "testing", work);
    } catch (const Error& e) {
      CHECK(std::string(e.what()) == message);
      return e.code();
    }
    return ExitCode::done;
  };
  CHECK(code_of([] {}, "") == ExitCode::done);
  CHECK(code_of([] { throw Error(ExitCode::bad_input, "no such key"); }, "no such key") == ExitCode::bad_input);
  CHECK(code_of([] { throw std::bad_alloc(); }, "out of memory while testing") == ExitCode::machine);
  CHECK(code_of([] { throw std::logic_error("odd"); }, "bug: odd (while testing)") == ExitCode::bug);
}

TEST_CASE("time of a phase adds up over its scopes") {
  Timers timers;
  double before = 0;
  for (int n = 0; n < 3; ++n) {
    { const auto timed = timers.measure("solve"); }
    CHECK(timers.seconds().at("solve") >= before);
    before = timers.seconds().at("solve");
  }
  CHECK(timers.seconds().size() == 1);
}

}  // namespace pieces_tests
