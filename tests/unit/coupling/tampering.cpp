// Operator perturbations.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "coupling/state/tampering.h"

using namespace seiche;

TEST_CASE("tampering changes the operator that is named and no other") {
  const Tampering none = parse_tampering("");
  CHECK(none.viscosity == 1);
  const Tampering t = parse_tampering("viscosity:-0.5");
  CHECK(t.viscosity == -0.5);
  CHECK(t.pressure_gradient == 1);
  CHECK_THROWS_WITH(parse_tampering("viscousity:2"), Catch::Contains("elastic_forces") && Catch::Contains("viscosity"));
  CHECK_THROWS_AS(parse_tampering("viscosity"), Error);
  CHECK_THROWS_AS(parse_tampering("viscosity:"), Error);
  CHECK_THROWS_AS(parse_tampering("viscosity:2x"), Error);
  CHECK_THROWS_AS(parse_tampering("viscosity:nan"), Error);
}
