// Separating walls: the viscous operator beside solids, and the active-set search for the cells that separate.
#include <catch2/catch.hpp>

#include "fluid/pressure/separation_search.h"
#include "viscous_case.h"

namespace viscous_parting_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

// Liquid below a tilted plane.
template <int Dim>
double tilted_surface(const Vec<Dim>& x) {
  return 0.9 * (x[1] - 0.61) + 0.3 * (x[0] - 0.5);
}

// Compares the operator with no separated cell and with many. No-slip ball, cut cells, a free surface.
template <int Dim>
void check_guess_of_separation() {
  Vec3 center = Vec3::Zero();
  center.head<Dim>().setConstant(0.51);
  ViscousCase<Dim> p({.cells = 8, .viscosity = 0.3, .solids = {viscous_ball(center, 0.2)}, .phi = tilted_surface<Dim>});
  Separation<Dim> separation(p.layout());
  p.let_part(separation);
  p.assemble();
  const Eigen::MatrixXd none = p.dense(true);
  const std::size_t cells = p.rows.cells.size();
  for_each_index_in_order(p.layout(), p.layout().cells(), [&](Site c, const IVec<Dim>& i) {
    const bool at_side = (i.array() == 0).any() || (i.array() == 7).any();
    separation.separated[c] = p.rows.has_own(c) && (at_side || c % 3 == 0);
  });
  p.assemble();
  CHECK(p.rows.cells.size() < cells);
  const Eigen::MatrixXd many = p.dense(true);
  REQUIRE(many.rows() == none.rows());
  CHECK((many - none).cwiseAbs().maxCoeff() == 0);
}

}  // namespace

TEST_CASE("masses and stresses do not depend on the guess of which cells part") {
  check_guess_of_separation<2>();
  check_guess_of_separation<3>();
}

TEST_CASE("a search for the cells that part which no guess satisfies ends, and says how wrong it is") {
  ViscousCase<2> p({.cells = 8, .solids = {}, .phi = tilted_surface<2>});
  Separation<2> separation(p.layout());
  p.let_part(separation);
  p.assemble();
  p.pressure.fill(-1);  // suction where cells have not separated,
  p.set(p.u_star, [](int a, const Vec<2>& x) { return -10 * (a == 0 ? x[0] : x[1]); });  // compression where they have
  SeparationSearch<2> search(p.projection(), 1e-7, nullptr, separation);
  int rounds = 0;
  while (!search.has_converged_with(p.rows, {}, p.pressure, p.u_star) && rounds < 1000) ++rounds;
  CHECK(rounds == 50);
  CHECK(search.error() >= 1);
}

// Suction in one cell of the wall, which an earlier solve of the step found to be separated.
TEST_CASE("a search for the cells that part goes on from those that an earlier solve found") {
  ViscousCase<2> p({.cells = 8, .solids = {}, .phi = tilted_surface<2>});
  Separation<2> separation(p.layout());
  p.let_part(separation);
  p.assemble();
  const Site corner = p.layout().site(IVec<2>(0, 0));
  p.pressure.fill(1);
  p.pressure[corner] = -1;
  SeparationSearch<2> cold(p.projection(), 1e-7, nullptr, separation);
  CHECK(!cold.has_converged_with(p.rows, {}, p.pressure, p.u_star));
  CHECK(separation.separated[corner]);
  const CellField<2, char> found = separation.separated;
  p.pressure.fill(0);
  SeparationSearch<2> warm(p.projection(), 1e-7, &found, separation);
  CHECK(separation.separated[corner]);
  CHECK(warm.has_converged_with(p.rows, {}, p.pressure, p.u_star));
  CHECK(warm.error() == 0);
}

}  // namespace viscous_parting_tests
