// Steps that would invert many elements without a bound on the step.
#include <random>

#include "unit/solid/elastic_cases.h"

namespace elastic_violent_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

// Number of failed steps out of ten (3D: four). Each node of a block starts with a random displacement per step of up
// to `reach` element sizes.
template <int Dim>
int failures(const char* material, double E, double reach, ElasticScheme scheme) {
  const int cells = Dim == 2 ? 3 : 2;
  const auto body = elastic_body<Dim>(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(cells), 2),
                                      material, 1000, E, 0.45);
  const double dt = 0.01;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> speed(-reach / cells / dt, reach / cells / dt);
  ElasticState state = at_rest(body);
  state.v = Eigen::VectorXd::NullaryExpr(body.size(), [&] { return speed(random); });
  ElasticWorkspace workspace;
  int failed = 0;
  for (int n = 0; n < (Dim == 2 ? 10 : 4); ++n) {
    const auto report =
        advance<Dim>(body, scheme, dt, {Eigen::VectorXd::Zero(body.size()), true}, {}, {}, workspace, state);
    failed += !report.converged;
    REQUIRE(report.least_volume_ratio > 0);
    REQUIRE(least_volume_ratio(body, state.u) > 0);
  }
  return failed;
}

}  // namespace

// The volume guard gives every material, also those of finite energy at inversion, a minimum with det F > 0. Newton
// always finds it for displacements of up to a third of an element per step. Three elements (3D: one) per step is
// beyond any sensible step; there Newton finds it for bodies that are not soft.
TEMPLATE_TEST_CASE_SIG("Violent motion never inverts an element", "[elastic][long]", ((int Dim), Dim), 2, 3) {
  const double wild = Dim == 2 ? 3 : 1;
  for (const auto& row : elastic_materials<Dim>()) {
    const std::string name(row.name);
    for (const auto scheme : {ElasticScheme::backward_euler, ElasticScheme::bdf2}) {
      INFO(name);
      for (double E : {1e2, 1e5, 1e12}) CHECK(failures<Dim>(name.c_str(), E, 0.3, scheme) == 0);
      for (double E : {1e5, 1e12}) CHECK(failures<Dim>(name.c_str(), E, wild, scheme) == 0);
    }
  }
}

}  // namespace elastic_violent_tests
