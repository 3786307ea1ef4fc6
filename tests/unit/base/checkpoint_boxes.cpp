#include "base/checkpoint_boxes.h"

#include <catch2/catch.hpp>

#include "base/error.h"

namespace checkpoint_boxes_tests {
using namespace seiche;

namespace {

// Values 100 k + 10 j + i.
FieldRecord numbered(const std::string& name, const std::array<int, 3>& lower, const std::array<int, 3>& upper) {
  FieldRecord field{name, lower, upper, {}};
  for (int k = lower[2]; k < upper[2]; ++k)
    for (int j = lower[1]; j < upper[1]; ++j)
      for (int i = lower[0]; i < upper[0]; ++i) field.values.push_back(100 * k + 10 * j + i);
  return field;
}

FieldRecord without_values(FieldRecord field) {
  field.values = {};
  return field;
}

}  // namespace

// On several ranks: parallel moved_blocks_agree.
TEST_CASE("redistributed fields have the values of their new boxes") {
  const Communicator alone(MPI_COMM_SELF);
  const auto all = [](const std::string& name) { return numbered(name, {0, 0, 0}, {4, 3, 2}); };
  const FieldRecord part = numbered("b", {1, 1, 0}, {3, 3, 1}), none = numbered("c", {2, 2, 2}, {2, 2, 2});
  const auto moved =
      redistribute({all("a"), all("b"), all("c")}, {without_values(all("a")), without_values(part), none}, alone);
  REQUIRE(moved.size() == 3);
  CHECK(moved[0].values == all("a").values);
  CHECK(moved[1].values == part.values);
  CHECK(moved[2].values.empty());
}

TEST_CASE("fields that no rank has in full are refused") {
  const FieldRecord part = numbered("a", {1, 1, 0}, {3, 3, 1}),
                    whole = without_values(numbered("a", {0, 0, 0}, {4, 3, 2}));
  CHECK_THROWS_AS(redistribute({part}, {whole}, Communicator(MPI_COMM_SELF)), Error);
}

TEST_CASE("what ranks exchange arrives by sender, empty texts too") {
  const Communicator alone(MPI_COMM_SELF);
  CHECK(alone.exchange({"one"}) == std::vector<std::string>{"one"});
  CHECK(alone.exchange({""}) == std::vector<std::string>{""});
}

}  // namespace checkpoint_boxes_tests
