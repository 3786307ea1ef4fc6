// Drops too small for a pressure of their own.
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
  StepGeometry<Dim> geometry = setup.solids.geometry.measure({}, 0);
  const Layout<Dim>& layout = setup.domain.layout;
  CellField<Dim> phi, share;
  FaceField<Dim> u;
  Site cell;

  explicit OneDrop(const IVec<Dim>& index) : phi(layout, 1.0), share(layout), u(layout), cell(layout.site(index)) {
    share[cell] = 1.0 / 3;
  }
  void let_drift(double dt) {
    seiche::let_drift(setup.domain, geometry.faces, share, drifting_cells(setup.domain, phi, share), FaceField<Dim>(u),
                      {0, -10, 0}, dt, u);
  }
  double low(int axis) const { return u.at(axis, cell); }
  double high(int axis) const { return u.at(axis, cell + layout.stride(axis)); }
};

template <int Dim>
void check_fall() {
  OneDrop<Dim> drop(IVec<Dim>::Constant(6));
  drop.u[0].fill(0.5);
  drop.let_drift(0.01);
  drop.u[1].fill(drop.low(1));  // as it is continued around
  drop.let_drift(0.01);
  CHECK(drop.low(0) == Approx(0.5));
  CHECK(drop.high(0) == Approx(0.5));
  CHECK(drop.low(1) == Approx(-0.2));
  CHECK(drop.high(1) == Approx(-0.2));
}

// The floor stops it, and gravity does not speed up the face above.
template <int Dim>
void check_floor() {
  IVec<Dim> index = IVec<Dim>::Constant(6);
  index[1] = 0;
  OneDrop<Dim> drop(index);
  for (int n = 0; n < 100; ++n) drop.let_drift(0.1);
  CHECK(drop.low(1) == 0);
  CHECK(drop.high(1) == 0);
}

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

TEST_CASE("a drop below a cell falls freely and keeps its speed along") {
  check_fall<2>();
  check_fall<3>();
}

TEST_CASE("a drop below a cell comes to rest on the floor") {
  check_floor<2>();
  check_floor<3>();
}

TEST_CASE("only liquid away from the level set's drifts") {
  check_beside_liquid<2>();
  check_beside_liquid<3>();
}

}  // namespace drifting_tests
