// Flow continued through the walls of no-slip solids.
#include "coupling/transport/flow_through_walls.h"

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/step/initial_state.h"
#include "grid/loops.h"
#include "verification/scenes.h"

namespace flow_through_walls_tests {
using namespace seiche;

namespace {

// A solid below the plane n.x = 0.5 m, in a box full of viscous liquid.
template <int Dim>
Scene scene_above_plane(const Vec3& n, Slip slip) {
  Scene s = test::box_scene(Dim, 16);
  test::add_liquid(s, "-1");
  s.liquid.viscosity = "1";
  SolidSpec& solid = s.solids.emplace_back();
  solid.name = "bank";
  solid.shape.kind = "plane";
  solid.shape.point = 0.5 * n;
  solid.shape.normal = n;
  solid.slip = slip;
  return s;
}

// u' = t (s + s^2/2) + n s^2/4 at s cells from the plane.
template <int Dim>
struct Profile {
  Vec<Dim> n, t;
  double h;
  Vec<Dim> operator()(const Vec<Dim>& x) const {
    const double s = (n.dot(x) - 0.5) / h;
    return (s + 0.5 * s * s) * t + 0.25 * s * s * n;
  }
};

// Largest error within 1.8 cells below the plane, away from the sides, over the largest velocity two cells above it.
template <int Dim>
double error_below(const Vec3& normal, Slip slip = Slip::no_slip) {
  const Setup<Dim> setup(scene_above_plane<Dim>(normal, slip), Communicator());
  const Layout<Dim>& layout = setup.domain.layout;
  const State<Dim> state = initial_state(setup);
  const StepGeometry<Dim> g = setup.solids.geometry.measure(place_bodies(state), 0);
  const Vec<Dim> n = truncate<Dim>(normal);
  Vec<Dim> t = Vec<Dim>::Zero();
  t[0] = -n[1], t[1] = n[0];
  const Profile<Dim> exact{n, t, layout.h()};
  FaceField<Dim> u(layout);
  const auto distance = [&](const Vec<Dim>& x) { return (n.dot(x) - 0.5) / layout.h(); };
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.padded(), [&](Site f, const IVec<Dim>& i) {
      const Vec<Dim> x = layout.position(i, face_offset<Dim>(a));
      u.at(a, f) = distance(x) > 0 ? exact(x)[a] : 0.3;
    });
  continue_through_walls(setup.domain, NoSlipSolids<Dim>(setup, state, g, 0), u);
  double worst = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.cells(), [&](Site f, const IVec<Dim>& i) {
      const Vec<Dim> x = layout.position(i, face_offset<Dim>(a));
      const double s = distance(x);
      if ((i.array() < 5).any() || (i.array() > 10).any() || s > 0 || s < -1.8) return;
      worst = std::max(worst, std::abs(u.at(a, f) - exact(x)[a]));
    });
  return worst / 4;
}

}  // namespace

// Samples read faces within the solid, too: each turn leaves a share of the error.
TEST_CASE("parabolas along a no-slip wall go on within it", "[viscous]") {
  CHECK(error_below<2>({0, 1, 0}) < 0.01);
  CHECK(error_below<2>({0.6, 0.8, 0}) < 0.01);
  CHECK(error_below<3>({0.36, 0.48, 0.8}) < 0.01);
}

TEST_CASE("beside walls that slip the flow stays as it was continued", "[viscous]") {
  CHECK(error_below<2>({0.6, 0.8, 0}, Slip::free_slip) > 0.05);
}

}  // namespace flow_through_walls_tests
