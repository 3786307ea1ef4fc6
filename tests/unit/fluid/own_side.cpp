// Liquid by the level set in cells beside solids, whatever phi is on their other side.
#include <catch2/catch.hpp>

#include "fluid/volume/own_side.h"
#include "grid/ghosts.h"
#include "grid/halo.h"
#include "grid/loops.h"

namespace own_side_tests {
using namespace seiche;

namespace {

// A leaning wall in a box of 12 cells an axis, `thick` cells thick, under a slanting surface. phi is 7 in cells without
// room, and that of other liquid beyond the wall.
template <int Dim>
struct Wall {
  Layout<Dim> layout;
  Communicator ranks;
  Halo<Dim> halo;
  NodeField<Dim> psi;
  CellField<Dim> phi, plane;
  OpenParts<Dim> open;

  explicit Wall(double thick)
      : layout(geometry(), geometry().box(), 4),
        halo(layout, {geometry().box()}, ranks),
        psi(layout),
        phi(layout),
        plane(layout) {
    for_each_index_in_order(layout, layout.padded(), [&](Site s, const IVec<Dim>& i) {
      psi[s] = std::abs(across(layout.position(i, node_offset<Dim>()))) - thick / 2;
    });
    FaceField<Dim> faces(layout);
    open_fractions(layout, psi, faces);
    PagedFaceField<Dim> paged(layout, 1);
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(layout, layout.faces(a), [&](Site f, const IVec<Dim>&) {
        if (faces.at(a, f) != 1) paged[a].set(f, faces.at(a, f));
      });
    open = measure_open_parts(layout, halo, psi, paged);
    for_each_index_in_order(layout, layout.padded(), [&](Site c, const IVec<Dim>& i) {
      const Vec<Dim> x = layout.position(i, cell_offset<Dim>());
      plane[c] = slope().dot(x) - 6.3;
      phi[c] = across(x) < 0 ? plane[c] : plane[c] + 4;
    });
    for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<Dim>&) {
      if (open.cells[c] == 0) phi[c] = 7;
    });
    extend_beyond_sides<Dim>(layout, phi.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::linear));
  }
  static Geometry<Dim> geometry() {
    Geometry<Dim> g;
    g.h = 1;
    g.cells = IVec<Dim>::Constant(12);
    return g;
  }
  static Vec<Dim> slope() { return truncate<Dim>(Vec3(0.3, 0.9, Dim == 3 ? 0.1 : 0.0)); }
  // Distance to the middle of the wall, m.
  static double across(const Vec<Dim>& x) { return 0.96 * (x[0] - 6.2) + 0.28 * (x[1] - 6); }
};

// Cells of the wall's low side have the share of the plane. Returns the number of those that a surface passes.
template <int Dim>
int cut_cells_beside(double thick) {
  const Wall<Dim> wall(thick);
  const Room<Dim> room(wall.open);
  int cut = 0;
  for_each_index_in_order(wall.layout, wall.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (room.of(c) == 0 || Wall<Dim>::across(wall.layout.position(i, cell_offset<Dim>())) > 0) return;
    const double exact = liquid_share(wall.layout, wall.plane, wall.psi, c);
    CHECK(liquid_share(wall.layout, room, wall.phi, wall.psi, c) == Approx(exact).margin(1e-12));
    if (room.of(c) < 1 && exact > 0 && exact < room.of(c)) ++cut;
  });
  return cut;
}

}  // namespace

TEST_CASE("level set's share of a cell beside a wall does not depend on what lies in and beyond the wall") {
  for (const double thick : {1.5, 2.5, 4.0}) {
    CAPTURE(thick);
    CHECK(cut_cells_beside<2>(thick) >= 1);
    CHECK(cut_cells_beside<3>(thick) >= 10);
  }
}

}  // namespace own_side_tests
