#include <catch2/catch.hpp>

#include "grid/ghosts.h"
#include "grid/halo.h"
#include "grid/interpolation.h"
#include "grid/loops.h"
#include "grid/partition.h"

namespace layout_tests {
using namespace seiche;

namespace {

template <int Dim>
Geometry<Dim> box(const IVec<Dim>& cells, bool periodic) {
  Geometry<Dim> g;
  g.h = 0.25;
  g.lower = Vec<Dim>::Constant(-1.5);
  g.cells = cells;
  g.periodic.fill(periodic);
  return g;
}

double cubic(const Vec<3>& x) {
  return 1 + x[0] * x[0] * x[0] - 2 * x[1] * x[1] * x[2] + 0.5 * x[2] * x[2] * x[2];
}

}  // namespace

TEST_CASE("a partition tiles the grid without overlap, idle ranks empty") {
  for (int ranks : {1, 2, 3, 4, 5, 7, 64}) {
    const Geometry<2> g = box<2>({7, 5}, false);
    const auto boxes = partition(g, ranks);
    REQUIRE(int(boxes.size()) == ranks);
    std::int64_t cells = 0;
    for (int a = 0; a < ranks; ++a) {
      cells += boxes[a].size();
      for (int b = 0; b < a; ++b) CHECK(boxes[a].cut(boxes[b]).empty());
    }
    CHECK(cells == 35);
  }
}

TEST_CASE("sites and indices are inverse, neighbours a stride away") {
  const Layout<3> layout(box<3>({6, 5, 4}, false), {{2, 1, 0}, {6, 5, 4}}, 3);
  for_each_index_in_order(layout, layout.padded(), [&](Site s, const IVec<3>& i) {
    CHECK(layout.index(s) == i);
    CHECK(layout.site(i) == s);
  });
  CHECK(layout.site({3, 2, 2}) - layout.site({3, 1, 2}) == layout.stride(1));
  CHECK(layout.faces(0).upper[0] == 7);  // the domain's last face belongs to this block
  CHECK(layout.faces(1).lower[1] == 1);
}

TEST_CASE("periodic halos hold the values one period away, also where the halo is wider than the grid") {
  const Geometry<2> g = box<2>({3, 8}, true);
  const Layout<2> layout(g, g.box(), 5);
  const Halo<2> halo(layout, {g.box()}, Communicator(MPI_COMM_SELF));
  CellField<2> f(layout, -1);
  const auto value = [&](const IVec<2>& i) { return 100.0 * ((i[0] % 3 + 3) % 3) + (i[1] % 8 + 8) % 8; };
  for_each_index(layout, layout.cells(), [&](Site s, const IVec<2>& i) { f[s] = value(i); });
  halo.fill_ghosts(f);
  for_each_index_in_order(layout, layout.padded(), [&](Site s, const IVec<2>& i) { CHECK(f[s] == value(i)); });
}

TEST_CASE("values beyond the sides: planes continue straight, walls mirror") {
  const Geometry<2> g = box<2>({6, 6}, false);
  const Layout<2> layout(g, g.box(), 3);
  CellField<2> plane(layout), even(layout), odd(layout);
  for_each_index(layout, layout.cells(), [&](Site s, const IVec<2>& i) { plane[s] = 2.0 * i[0] - i[1]; });
  extend_beyond_sides<2>(layout, plane.data(), cell_offset<2>(), all_sides<2>(Extension::linear));
  for_each_index_in_order(layout, layout.padded(),
                          [&](Site s, const IVec<2>& i) { CHECK(plane[s] == 2.0 * i[0] - i[1]); });

  for_each_index(layout, layout.cells(), [&](Site s, const IVec<2>& i) { even[s] = i[0] * i[0]; });
  extend_beyond_sides<2>(layout, even.data(), cell_offset<2>(), all_sides<2>(Extension::mirror));
  CHECK(even[layout.site({-1, 2})] == even[layout.site({0, 2})]);
  CHECK(even[layout.site({-3, 2})] == even[layout.site({2, 2})]);

  for_each_index(layout, layout.faces(0), [&](Site s, const IVec<2>& i) { odd[s] = 1 + i[0]; });
  extend_beyond_sides<2>(layout, odd.data(), face_offset<2>(0), all_sides<2>(Extension::mirror));
  CHECK(odd[layout.site({-2, 2})] == -1);  // 2 u_wall - u(2) = 2 - 3
  CHECK(odd[layout.site({8, 2})] == 9);    // 2 u_wall - u(4) = 14 - 5
}

TEST_CASE("four-point interpolation is exact for cubics, two-point for linear functions") {
  const Geometry<3> g = box<3>({8, 8, 8}, false);
  const Layout<3> layout(g, g.box(), 3);
  CellField<3> f(layout), linear(layout);
  for_each_index(layout, layout.padded(), [&](Site s, const IVec<3>& i) {
    const Vec<3> x = layout.position(i, cell_offset<3>());
    f[s] = cubic(x);
    linear[s] = 3 - x[0] + 2 * x[1] - 4 * x[2];
  });
  for (double t : {0.0, 0.13, 0.5, 0.77}) {
    const Vec<3> x(-0.3 + t, 0.1 - t / 2, -0.9 + t / 3);
    const Vec<3> at = index_coordinates<3>(layout, x, cell_offset<3>());
    // Round-off: sums of 64 terms of order ten.
    CHECK(interpolate_cubic<3>(layout, f.data(), at) == Approx(cubic(x)).margin(1e-13));
    CHECK(interpolate_linear<3>(layout, linear.data(), at) == Approx(3 - x[0] + 2 * x[1] - 4 * x[2]).margin(1e-13));
  }
}

TEST_CASE("sums and maxima do not depend on how the box is cut into rows") {
  const Geometry<3> g = box<3>({40, 30, 20}, false);
  const Layout<3> layout(g, g.box(), 2);
  const auto count = [](Site, const IVec<3>&) { return 1.0; };
  CHECK(local_sum(layout, layout.cells(), count) == 24000);
  CHECK(local_max(layout, layout.cells(), -1.0, [](Site s) { return double(s); }) == double(layout.site({39, 29, 19})));
}

}  // namespace layout_tests
