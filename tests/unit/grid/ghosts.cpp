// Values beyond the sides of the domain.
#include "grid/ghosts.h"

#include <catch2/catch.hpp>

#include "grid/fields.h"
#include "grid/loops.h"

namespace ghosts_tests {
using namespace seiche;

namespace {

Layout<3> cube(int n) {
  Geometry<3> g;
  g.cells = IVec<3>::Constant(n);
  g.h = 1.0 / n;
  return Layout<3>(g, g.box(), 3);
}

}  // namespace

// Some slopes exceed the limit, others do not. The limit may act on one axis before or after the other.
TEST_CASE("values beyond edges and corners do not depend on the order of the axes") {
  const Layout<3> layout = cube(4);
  const auto value = [](const IVec<3>& i) { return std::sin(1.3 * i[0]) + 0.4 * i[1] * i[1] - 0.7 * i[2] * i[0]; };
  CellField<3> plain(layout, 0.0), turned(layout, 0.0);
  for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<3>& i) {
    plain[c] = value(i);
    turned[c] = value({i[1], i[2], i[0]});
  });
  for (CellField<3>* f : {&plain, &turned})
    extend_beyond_sides<3>(layout, f->data(), cell_offset<3>(), all_sides<3>(Extension::linear), 0.5);
  double worst = 0;
  for_each_index_in_order(layout, layout.padded(), [&](Site c, const IVec<3>& i) {
    worst = std::max(worst, std::abs(turned[c] - plain[layout.site({i[1], i[2], i[0]})]));
  });
  CHECK(worst <= 1e-14);  // sums in a different order
}

TEST_CASE("planes stay planes beyond edges and corners") {
  const Layout<3> layout = cube(4);
  const auto plane = [](const IVec<3>& i) { return 0.3 * i[0] - 0.2 * i[1] + 0.1 * i[2] + 0.05; };
  CellField<3> f(layout, 0.0);
  for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<3>& i) { f[c] = plane(i); });
  extend_beyond_sides<3>(layout, f.data(), cell_offset<3>(), all_sides<3>(Extension::linear), 1.0);
  double worst = 0;
  for_each_index_in_order(layout, layout.padded(),
                          [&](Site c, const IVec<3>& i) { worst = std::max(worst, std::abs(f[c] - plane(i))); });
  CHECK(worst <= 1e-14);  // six sums of numbers of order 1
}

}  // namespace ghosts_tests
