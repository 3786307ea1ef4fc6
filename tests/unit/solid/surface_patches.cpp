// Patches of a surface between pins, and volumes enclosed by patches of several solids.
#include <catch2/catch.hpp>

#include "base/solid_spec.h"
#include "solid/body/enclosed_volume.h"
#include "solid/elastic/surface_patches.h"
#include "unit/solid/wall_specs.h"

namespace surface_patches_tests {
using namespace seiche;
using test::box;

namespace {

const Vec3 low_corner(0, 0, 0), high_corner(1, 1, 1);

// Pins nodes below a plane x_axis = at (side 0) or above it (side 1).
void pin(SolidSpec& s, int axis, int side, double at, const Formula& lift = "0") {
  PinSpec p;
  p.shape.kind = "box";
  p.shape.where = "test";
  p.shape.lower = {-9, -9, -9};
  p.shape.upper = {9, 9, 9};
  (side == 0 ? p.shape.upper : p.shape.lower)[axis] = at;
  p.motion.translate[1] = lift;
  s.elastic.pinned.push_back(p);
}

template <int Dim>
ElasticSolid<Dim> make(const SolidSpec& s) {
  return make_elastic_solid<Dim>(s, {0.05, nullptr}, truncate<Dim>(low_corner), truncate<Dim>(high_corner));
}

// An upright wall between the floor and a moving solid.
ElasticSolid<2> upright(double x, const Formula& lift) {
  SolidSpec s = box(SolidKind::elastic, {x, 0, 0}, {x + 0.1, 0.5, 0});
  pin(s, 1, 0, 0);
  pin(s, 1, 1, 0.5, lift);
  return make<2>(s);
}

// The patch of a wall with points at x.
int patch_at(const ElasticSolid<2>& wall, double x) {
  for (std::size_t k = 0; k < wall.patches.size(); ++k) {
    const auto node = std::size_t(wall.surface.nodes[std::size_t(wall.patches[k].facets[0][0])]);
    if (std::abs(wall.body.mesh.nodes[node][0] - x) < 1e-9) return int(k);
  }
  return -1;
}

Eigen::VectorXd held_at(const ElasticSolid<2>& wall, double t) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(wall.body.size());
  const Pins pins = pins_at(wall, t);
  for (std::size_t n = 0; n < pins.dofs.size(); ++n) u[pins.dofs[n]] = pins.targets[n];
  return u;
}

}  // namespace

TEST_CASE("pins at both ends divide a strip's outline into two sides", "[elastic][sealed]") {
  const ElasticSolid<2> wall = upright(0.2, "t");
  REQUIRE(wall.patches.size() == 2);
  for (const auto& patch : wall.patches) {
    CHECK(patch.closings.size() == 2);
    for (const auto& closing : patch.closings) CHECK(closing.pin >= 0);
  }
  SolidSpec one = box(SolidKind::elastic, {0.2, 0, 0}, {0.3, 0.5, 0});
  pin(one, 1, 0, 0);
  const ElasticSolid<2> flap = make<2>(one);
  REQUIRE(flap.patches.size() == 1);
  CHECK(flap.patches[0].is_closed());
  CHECK(enclosed_volume<2>({{&flap, 0, 0}}, {Eigen::VectorXd::Zero(flap.body.size())}) == Approx(0.05));
}

TEST_CASE("in 3D what is pinned all round has two sides", "[elastic][sealed]") {
  SolidSpec column = box(SolidKind::elastic, {0.2, 0, 0.2}, {0.4, 0.6, 0.4});
  pin(column, 1, 0, 0);
  pin(column, 1, 1, 0.6);
  CHECK(make<3>(column).patches.size() == 1);
  SolidSpec plate = box(SolidKind::elastic, {0, 0.4, 0}, {0.6, 0.5, 0.6});
  for (const int axis : {0, 2})
    for (const int side : {0, 1}) pin(plate, axis, side, side == 0 ? 0 : 0.6);
  const ElasticSolid<3> across = make<3>(plate);
  REQUIRE(across.patches.size() == 2);
  for (int k : {0, 1}) {
    const CavityWalls<3> walls{{&across, 0, k}};
    CHECK(can_be_closed(walls));
    Eigen::VectorXd u = Eigen::VectorXd::Zero(across.body.size());
    const double flat = enclosed_volume(walls, {u});
    CHECK(std::abs(flat) < 1e-14);
    // A free node on the side sweeps a third of the area of its facets times its displacement.
    const Eigen::VectorXd g = enclosed_volume_gradient(walls, 0, u);
    Eigen::Index n = 0;
    const double most = g.cwiseAbs().maxCoeff(&n);
    u[n] = 1e-3;
    CHECK(std::abs(enclosed_volume(walls, {u}) - 1e-3 * g[n]) < 1e-12 * most);
  }
}

TEST_CASE("two walls, floor and lid enclose what lies between them", "[elastic][sealed]") {
  const Formula lift = "-t";
  const ElasticSolid<2> low = upright(0.2, lift), high = upright(0.7, lift);
  const CavityWalls<2> walls{{&low, 0, patch_at(low, 0.3)}, {&high, 1, patch_at(high, 0.7)}};
  REQUIRE(can_be_closed(walls));
  CHECK_FALSE(can_be_closed(CavityWalls<2>{walls[0]}));
  std::vector<Eigen::VectorXd> u{held_at(low, 0), held_at(high, 0)};
  CHECK(enclosed_volume(walls, u) == Approx(-0.4 * 0.5).epsilon(1e-14));
  SECTION("the lid comes down, its walls' sides bend") {
    u = {held_at(low, 0.05), held_at(high, 0.05)};
    const double before = enclosed_volume(walls, u);
    for (std::size_t k : {0, 1}) {
      const Eigen::VectorXd g = enclosed_volume_gradient(walls, k, u[k]);
      for (Eigen::Index i = 0; i < g.size(); ++i) {
        std::vector<Eigen::VectorXd> moved = u;
        moved[k][i] += 1e-3;
        if (g[i] != 0) CHECK(std::abs(enclosed_volume(walls, moved) - before - 1e-3 * g[i]) < 1e-15);
      }
    }
  }
  SECTION("a wall with another motion at its end does not close it") {
    const ElasticSolid<2> other = upright(0.7, "-2*t");
    CHECK_FALSE(can_be_closed(CavityWalls<2>{walls[0], {&other, 1, patch_at(other, 0.7)}}));
  }
}

}  // namespace surface_patches_tests
