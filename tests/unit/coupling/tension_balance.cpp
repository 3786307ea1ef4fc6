// Force and torque of surface tension on closed pieces of surface.
#include "coupling/tension/tension_balance.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "grid/loops.h"
#include "levelset/redistance.h"
#include "verification/scenes.h"

namespace tension_balance_tests {
using namespace seiche;

namespace {

// An ellipse or ellipsoid with uneven curvatures, `by` cells of 1/24 along x from the middle of its box.
template <int Dim>
struct UnevenDrop {
  Setup<Dim> setup;
  const Layout<Dim>& layout = setup.domain.layout;
  Vec<Dim> centre;
  CellField<Dim> phi;
  FaceField<Dim, char> crossed;
  FaceField<Dim> kappa;

  UnevenDrop(const Scene& scene, double by)
      : setup(scene, Communicator()), centre(Vec<Dim>::Constant(0.5)), phi(layout), crossed(layout), kappa(layout) {
    centre[0] += by / 24;
    for_each_index(layout, layout.cells(), [&](Site c, const IVec<Dim>& i) {
      Vec<Dim> r = from_centre(layout.position(i, cell_offset<Dim>()));
      r[1] += 0.4 * r[0];
      phi[c] = r.norm() - 0.23;
    });
    fill_level_set_ghosts(layout, setup.domain.halo, phi);
    for (int a = 0; a < Dim; ++a)
      for_each_index(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
        if ((phi[f - layout.stride(a)] < 0) == (phi[f] < 0)) return;
        const Vec<Dim> r = from_centre(layout.position(i, face_offset<Dim>(a)));
        crossed.at(a, f) = 1;
        kappa.at(a, f) = 4 + std::sin(17 * r[0] + 3 * a) * std::cos(13 * r[1] + 1);
      });
    setup.domain.halo.fill_ghosts(crossed);
  }

  // The short way round the periodic axis x.
  Vec<Dim> from_centre(Vec<Dim> x) const {
    x -= centre;
    if (layout.geometry().periodic[0]) x[0] -= std::round(x[0]);
    return x;
  }

  // Sums of +-kappa e and of +-kappa r x e over the links, from their centre; z alone in 2D.
  std::pair<Vec3, Vec3> force_and_torque() const {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
        if (!crossed.at(a, f) || (i[a] == layout.geometry().cells[a] && layout.geometry().periodic[a])) return;
        const Vec3 push = (phi[f] < 0 ? -1 : 1) * kappa.at(a, f) * Vec3::Unit(a);
        force += push;
        torque += extend<Dim>(from_centre(layout.position(i, face_offset<Dim>(a)))).cross(push);
      });
    return {force, torque};
  }
  void balance() { balance_closed_pieces(setup.domain, setup.fluids, FaceGeometry<Dim>(layout), phi, crossed, kappa); }
};

template <int Dim>
void check_balance(const Scene& scene, double by) {
  UnevenDrop<Dim> drop(scene, by);
  const auto [force, torque] = drop.force_and_torque();
  CHECK(force.norm() > 0.1);
  CHECK(torque.norm() > 0.01);
  drop.balance();
  const auto [force_left, torque_left] = drop.force_and_torque();
  WARN(Dim << "D: force " << force.norm() << " -> " << force_left.norm() << ", torque " << torque.norm() << " -> "
           << torque_left.norm());
  CHECK(force_left.norm() < 1e-12 * force.norm());
  CHECK(torque_left.norm() < 1e-11 * torque.norm());
}

}  // namespace

TEST_CASE("a closed surface exerts neither force nor torque") {
  check_balance<2>(test::box_scene(2, 24), 0.3);
  check_balance<3>(test::box_scene(3, 24), 0.3);
}

TEST_CASE("nor does one that lies across a periodic side") {
  for (const int dim : {2, 3}) {
    Scene scene = test::box_scene(dim, 24);
    for (SideSpec& side : scene.domain.sides[0]) side.type = SideType::periodic;
    dim == 2 ? check_balance<2>(scene, 11.7) : check_balance<3>(scene, 11.7);
  }
}

}  // namespace tension_balance_tests
