// Sites that a step's transport may touch.
#include "coupling/transport/reached_sites.h"

#include <catch2/catch.hpp>

#include "coupling/state/setup.h"
#include "grid/loops.h"
#include "verification/scenes.h"

namespace reached_sites_tests {
using namespace seiche;

namespace {

// Marks one face of the domain as near; then checks each stored site by its distance along the axes.
template <int Dim>
void check_reach(bool periodic) {
  Scene scene = test::box_scene(Dim, 24);
  if (periodic) test::make_periodic(scene);
  const Setup<Dim> setup(scene, Communicator());
  const Layout<Dim>& layout = setup.domain.layout;
  FaceField<Dim, char> near(layout);
  const IVec<Dim> face = IVec<Dim>::Constant(3);
  near.at(Dim - 1, layout.site(face)) = 1;
  const CellField<Dim, char> reached = reached_sites(setup.domain, near);
  for_each_index_in_order(layout, layout.padded(), [&](Site s, const IVec<Dim>& i) {
    int far = 0;
    for (int a = 0; a < Dim; ++a) {
      const int along = std::abs(i[a] - face[a]), n = layout.geometry().cells[a];
      far = std::max(far, periodic ? std::min(along % n, n - along % n) : along);
    }
    CHECK(int(reached[s]) == int(far <= 2 * layout.halo()));
  });
}

}  // namespace

TEST_CASE("transport reaches two halo widths from the faces near a fluid, round periodic sides as well") {
  const bool periodic = GENERATE(false, true);
  check_reach<2>(periodic);
  check_reach<3>(periodic);
}

TEST_CASE("transport of a fluid that is nowhere reaches nothing") {
  const Setup<2> setup(test::box_scene(2, 16), Communicator());
  const CellField<2, char> reached = reached_sites(setup.domain, FaceField<2, char>(setup.domain.layout));
  for_each_index_in_order(setup.domain.layout, setup.domain.layout.padded(),
                          [&](Site s, const IVec<2>&) { CHECK(reached[s] == 0); });
}

}  // namespace reached_sites_tests
