// Loads on free solids that are known before the solve.
#include "coupling/solids/known_loads.h"

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/step/initial_state.h"
#include "verification/scenes.h"

namespace known_loads_tests {
using namespace seiche;

namespace {

Scene scene_of_disc() {
  Scene s = test::box_scene(2, 8);
  SolidSpec& disc = s.solids.emplace_back();
  disc.name = "disc";
  disc.kind = SolidKind::rigid;
  disc.shape.kind = "sphere";
  disc.shape.center = {0.5, 0.5, 0};
  disc.shape.radius = 0.2;
  disc.rigid.density = 1000;
  return s;
}

// Push of the load (3, 4) N, 5 N m about the disc's centre, over 0.1 s: by stress, or for carrying fluid of the disc's
// own mass.
Eigen::VectorXd push_on_disc(Freedom sideways, bool carries = false) {
  const Setup<2> setup(scene_of_disc(), Communicator());
  const State<2> state = initial_state(setup);
  const StepGeometry<2> g = setup.solids.geometry.measure(place_bodies(state), 0);
  SolidCoupling<2> c;
  c.bodies = {0};
  c.first = {0, 3};
  c.push = Eigen::VectorXd::Ones(3);
  c.freedom = {sideways, Freedom::free, Freedom::free};
  c.mass = SparseMatrix(Eigen::Matrix3d(2 * Eigen::Matrix3d::Identity()).sparseView());
  KnownLoads loads;
  const SolidLoad load{Vec3(3, 4, 0), Vec3(0, 0, 5)};
  (carries ? loads.carrying : loads.stress).push_back(load);
  if (carries) loads.carried = {2 * Eigen::Matrix<double, 6, 6>::Identity()};
  push_by<2>(loads, state.solids, g, 0.1, c);
  return c.push - Eigen::VectorXd::Ones(3);
}

}  // namespace

TEST_CASE("a known load pushes a free disc, but not along fixed axes", "[rigid]") {
  CHECK((push_on_disc(Freedom::free) - Eigen::Vector3d(0.3, 0.4, 0.5)).norm() == Approx(0).margin(1e-14));
  CHECK((push_on_disc(Freedom::fixed) - Eigen::Vector3d(0, 0.4, 0.5)).norm() == Approx(0).margin(1e-14));
}

TEST_CASE("fluid that moves with a free disc shares the load of carrying it", "[rigid]") {
  CHECK((push_on_disc(Freedom::free, true) - Eigen::Vector3d(0.15, 0.2, 0.25)).norm() == Approx(0).margin(1e-14));
}

}  // namespace known_loads_tests
