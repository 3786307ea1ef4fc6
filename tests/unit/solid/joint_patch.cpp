// Patches of elastic solids that joints hold: places and rates, and regions that do not serve.
#include <catch2/catch.hpp>

#include <random>

#include "base/error.h"
#include "solid/joint/patch.h"
#include "solid/rigid/motion.h"

namespace joint_patch_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

ShapeSpec box(const Vec3& lower, const Vec3& upper) {
  ShapeSpec shape;
  shape.kind = "box";
  shape.lower = lower;
  shape.upper = upper;
  shape.where = "scene.toml:7";
  return shape;
}

template <int Dim>
ElasticSolid<Dim> bar(bool pinned = false) {
  SolidSpec s;
  s.name = "bar";
  s.kind = SolidKind::elastic;
  s.shape = box({0, 0, 0}, {1, 0.2, 0.2});
  s.rigid.density = 1000;
  s.elastic.youngs_modulus = 1e6;
  s.elastic.poisson_ratio = 0.3;
  s.elastic.element_size = 0.1;
  if (pinned) s.elastic.pinned.push_back({box({-1, -1, -1}, {0.05, 1, 1}), {}});
  return make_elastic_solid<Dim>(s, {0.1}, Vec<Dim>::Constant(-2), Vec<Dim>::Constant(2));
}

Eigen::VectorXd random_numbers(std::mt19937& random, Eigen::Index size) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd v(size);
  for (double& x : v) x = uniform(random);
  return v;
}

template <int Dim>
void check_rates() {
  std::mt19937 random(7);
  const ElasticSolid<Dim> solid = bar<Dim>();
  const JointPatch<Dim> patch = make_patch(solid, box({-1, -1, -1}, {0.31, 1, 1}), {0.1}, "j", "bar");
  const Eigen::VectorXd u = 0.05 * random_numbers(random, solid.body.size()), v = random_numbers(random, u.size());
  const double dt = 1e-5;
  const PlacedPatch<Dim> now = place_patch(patch, u), low = place_patch<Dim>(patch, u - dt * v),
                         high = place_patch<Dim>(patch, u + dt * v);
  Eigen::Matrix<double, 6, 1> rate = Eigen::Matrix<double, 6, 1>::Zero();
  for (const auto& [unknown, part] : now.rates) rate += v[unknown] * part;
  const Vec3 velocity = (high.body.about - low.body.about) / (2 * dt);
  const Vec3 turn = log_rotation(high.body.pose.rotation * low.body.pose.rotation.transpose()) / (2 * dt);
  CHECK((rate.head<3>() - velocity).norm() <= 1e-8);
  CHECK((rate.tail<3>() - turn).norm() <= 1e-6 * turn.norm());  // of the difference quotient
  CHECK(turn.norm() > 0.1);
}

// Nodes that move rigidly give the motion itself.
template <int Dim>
void check_rigid() {
  const ElasticSolid<Dim> solid = bar<Dim>();
  const JointPatch<Dim> patch = make_patch(solid, box({-1, -1, -1}, {0.31, 1, 1}), {0.1}, "j", "bar");
  const Eigen::Matrix3d turn = exp_rotation(Dim == 2 ? Vec3(0, 0, 2) : Vec3(1, -1.2, 0.7));
  Eigen::VectorXd u(solid.body.size()), v(u.size());
  const Vec3 w = Dim == 2 ? Vec3(0, 0, 3) : Vec3(0.3, 2, -1);
  for (std::size_t n = 0; n < solid.body.mesh.nodes.size(); ++n) {
    const Vec3 X = extend<Dim>(solid.body.mesh.nodes[n]);
    u.segment<Dim>(Dim * Eigen::Index(n)) = truncate<Dim>(Vec3(turn * X - X + Vec3(0.3, 0.2, 0)));
    v.segment<Dim>(Dim * Eigen::Index(n)) = truncate<Dim>(Vec3(w.cross(turn * X)));
  }
  const PlacedPatch<Dim> placed = place_patch(patch, u);
  CHECK((placed.body.pose.rotation - turn).norm() <= 1e-12);
  CHECK((placed.body.pose.apply(Vec3::Zero()) - Vec3(0.3, 0.2, 0)).norm() <= 1e-12);
  Eigen::Matrix<double, 6, 1> rate = Eigen::Matrix<double, 6, 1>::Zero();
  for (const auto& [unknown, part] : placed.rates) rate += v[unknown] * part;
  CHECK((rate.tail<3>() - w).norm() <= 1e-12);
}

}  // namespace

TEST_CASE("rates of a patch are those of its mean place and rotation") {
  check_rates<2>();
  check_rates<3>();
}

TEST_CASE("a patch that moves rigidly has that motion") {
  check_rigid<2>();
  check_rigid<3>();
}

TEST_CASE("a region of a joint must hold enough free nodes") {
  const auto make = [](bool pinned, const Vec3& lower, const Vec3& upper) {
    (void)make_patch(bar<3>(pinned), box(lower, upper), {0.1}, "j", "bar");
  };
  CHECK_THROWS_WITH(make(false, {2, 0, 0}, {3, 1, 1}),
                    Contains("scene.toml:7: the region of joint 'j' contains none of"));
  CHECK_THROWS_WITH(make(true, {-1, -1, -1}, {0.5, 1, 1}), Contains("holds pinned nodes of solid 'bar'"));
  CHECK_THROWS_WITH(make(false, {-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}), Contains("all on a line; enlarge it"));
}

}  // namespace joint_patch_tests
