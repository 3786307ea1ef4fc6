// Operator perturbations.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "coupling/state/operator_perturbation.h"

namespace operator_perturbation_tests {
using namespace seiche;

TEST_CASE("a perturbation changes the operator that is named and no other") {
  const OperatorPerturbation none = parse_perturbation("");
  CHECK(none.viscosity == 1);
  const OperatorPerturbation t = parse_perturbation("viscosity:-0.5");
  CHECK(t.viscosity == -0.5);
  CHECK(t.pressure_gradient == 1);
  CHECK_THROWS_WITH(parse_perturbation("viscousity:2"),
                    Catch::Contains("elastic_forces") && Catch::Contains("viscosity"));
  CHECK_THROWS_AS(parse_perturbation("viscosity"), Error);
  CHECK_THROWS_AS(parse_perturbation("viscosity:"), Error);
  CHECK_THROWS_AS(parse_perturbation("viscosity:2x"), Error);
  CHECK_THROWS_AS(parse_perturbation("viscosity:nan"), Error);
}

}  // namespace operator_perturbation_tests
