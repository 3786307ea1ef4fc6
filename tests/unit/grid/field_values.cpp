// Values of fields: an array that all threads copy and fill.
#include <catch2/catch.hpp>
#include <numeric>

#include "grid/field_values.h"

namespace field_values_tests {
using namespace seiche;

namespace {

FieldValues<double> rising(std::size_t size) {
  FieldValues<double> values(size);
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

}  // namespace

TEST_CASE("field values are copied, moved, filled and compared like arrays") {
  constexpr std::size_t size = 100003;  // several tasks, the last one short
  const FieldValues<double> first = rising(size);
  FieldValues<double> copy = first, small(3, 7.0);
  CHECK(copy == first);
  copy[size - 1] = 0;
  CHECK_FALSE(copy == first);
  small = first;
  CHECK(small == first);
  small = FieldValues<double>(2, 5.0);
  CHECK((small.size() == 2 && small[0] == 5 && small[1] == 5));
  FieldValues<double> moved = std::move(copy);
  CHECK((moved.size() == size && copy.empty()));  // NOLINT(bugprone-use-after-move): what moving leaves
  moved.assign(size, 2.0);
  CHECK(std::count(moved.begin(), moved.end(), 2.0) == std::ptrdiff_t(size));
  moved = moved;  // NOLINT(clang-diagnostic-self-assign-overloaded)
  CHECK(moved.size() == size);
  CHECK(FieldValues<char>().empty());
}

}  // namespace field_values_tests
