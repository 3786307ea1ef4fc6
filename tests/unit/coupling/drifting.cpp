// Liquid that drops are made of.
#include "coupling/transport/drifting.h"

#include <catch2/catch.hpp>

#include "coupling/state/setup.h"
#include "verification/scenes.h"

namespace drifting_tests {
using namespace seiche;

namespace {

// An empty box of walls with a third of one cell full.
template <int Dim>
struct OneDrop {
  Setup<Dim> setup{test::box_scene(Dim, 12), Communicator()};
  const Layout<Dim>& layout = setup.domain.layout;
  CellField<Dim> phi, share;
  Site cell;

  explicit OneDrop(const IVec<Dim>& index) : phi(layout, 1.0), share(layout), cell(layout.site(index)) {
    share[cell] = 1.0 / 3;
  }
};

// The level set's liquid carries what is beside it.
template <int Dim>
void check_beside_liquid() {
  OneDrop<Dim> drop(IVec<Dim>::Constant(6));
  CHECK(drifting_cells(drop.setup.domain, drop.phi, drop.share) == std::vector<Site>{drop.cell});
  drop.phi[drop.cell + drop.layout.stride(0)] = -0.01;
  CHECK(drifting_cells(drop.setup.domain, drop.phi, drop.share).empty());
  drop.phi[drop.cell + drop.layout.stride(0)] = 1;
  drop.share[drop.cell] = 1e-9;
  CHECK(drifting_cells(drop.setup.domain, drop.phi, drop.share).empty());
}

}  // namespace

TEST_CASE("only liquid away from the level set's drifts") {
  check_beside_liquid<2>();
  check_beside_liquid<3>();
}

}  // namespace drifting_tests
