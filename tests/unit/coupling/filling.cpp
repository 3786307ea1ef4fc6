// Cells of air that a flow fills beyond what they hold.
#include "coupling/transport/filling.h"

#include <catch2/catch.hpp>

#include "coupling/state/setup.h"
#include "verification/scenes.h"

namespace filling_tests {
using namespace seiche;

namespace {

constexpr int gap = 6;  // row of cells

// Liquid in a box of 12 rows, but for a gap in the middle that is half full. `open`: the uppermost rows are air.
template <int Dim>
struct Gap {
  Setup<Dim> setup{test::box_scene(Dim, 12), Communicator()};
  StepGeometry<Dim> geometry = setup.solids.geometry.measure({}, 0);
  const Layout<Dim>& layout = setup.domain.layout;
  CellField<Dim> phi, share;
  FaceField<Dim> u, u_star;
  Filling<Dim> filling;
  Site cell;

  explicit Gap(bool open) : phi(layout), share(layout), u(layout), u_star(layout) {
    IVec<Dim> middle = IVec<Dim>::Constant(6);
    middle[1] = gap;
    cell = layout.site(middle);
    for_each_index(layout, layout.padded(), [&](Site c, const IVec<Dim>& i) {
      const bool air = open && i[1] > gap + 3;
      phi[c] = (air ? 0.5 : i[1] == gap ? 0.2 : -0.5) * layout.h();
      share[c] = air ? 0 : i[1] == gap ? 0.5 : 1;
    });
  }
  // Both sides of the gap move towards its middle. Returns whether cells have no room.
  bool close(double cells) {
    for_each_index(layout, layout.padded(), [&](Site f, const IVec<Dim>& i) {
      u.at(1, f) = i[1] <= gap ? cells * layout.h() : -cells * layout.h();
    });
    return add_filling_cells(setup.domain, geometry.faces, {share, u, Vec3(0, 0, 0), 1.0}, u, phi, u_star, filling);
  }
};

// Half a cell comes from each side: 1.5 cells of liquid and half a cell of air would be in the gap. The air may be
// filled.
template <int Dim>
void check_gap() {
  Gap<Dim> g(true);
  CHECK(g.close(0.5));
  const double layer = 2.0 / (Dim == 2 ? 6 : 4);  // cells between the points that it is measured with
  CHECK(g.filling.inflow[g.cell] / g.layout.h() == Approx(0.5).margin(0.51 * layer));
  CHECK(g.phi[g.cell] < 0);
  CHECK(g.filling.phi[g.cell] == 0.2 * g.layout.h());
}

}  // namespace

TEST_CASE("a gap that closes counts as liquid when it has no room for what comes", "[filling]") {
  check_gap<2>();
  check_gap<3>();
}

TEST_CASE("a gap that still has room stays air", "[filling]") {
  CHECK_FALSE(Gap<2>(true).close(0.15));
  CHECK_FALSE(Gap<3>(true).close(0.15));
}

TEST_CASE("the last air of a box stays air", "[filling]") {
  Gap<2> g(false);
  CHECK_FALSE(g.close(0.5));
  CHECK(g.filling.empty());
  CHECK(g.phi[g.cell] > 0);
}

}  // namespace filling_tests
