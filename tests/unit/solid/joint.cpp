// Constraints and coordinates of joints: their rates, and the momenta that loads along them keep.
#include <catch2/catch.hpp>

#include <random>

#include "solid/joint/force.h"
#include "solid/joint/joint.h"
#include "solid/rigid/motion.h"

namespace joint_tests {
using namespace seiche;

namespace {

using Rate = Eigen::Matrix<double, 6, 1>;

Vec3 random_vector(std::mt19937& random, int dimension, bool turn = false) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vec3 v(uniform(random), uniform(random), uniform(random));
  if (dimension == 2) v = turn ? Vec3(0, 0, v[2]) : Vec3(v[0], v[1], 0);
  return v;
}

JointedBody moved(const JointedBody& body, const Rate& rate, double dt) {
  JointedBody next = body;
  const Vec3 about = body.about + dt * rate.head<3>();
  next.pose.rotation = exp_rotation(dt * rate.tail<3>()) * body.pose.rotation;
  next.pose.displacement = Vec3::Zero();
  next.pose.displacement = about - next.pose.apply(body.pose.to_rest(body.about));
  next.about = about;
  return next;
}

JointSpec spec_of(JointKind kind, int dimension) {
  JointSpec spec;
  spec.kind = kind;
  spec.at = {0.3, 0.2, dimension == 3 ? 0.4 : 0};
  spec.to = {-0.2, 0.5, dimension == 3 ? 0.1 : 0};
  if (dimension == 3) spec.axis = Vec3(0.3, -0.5, 0.8);
  if (dimension == 2 && kind == JointKind::slider) spec.axis = Vec3(0.6, 0.8, 0);
  spec.second = spec.axis.cross(Vec3(1, 0, 0));
  return spec;
}

using Bodies = std::array<JointedBody, 2>;
Bodies random_bodies(std::mt19937& random, int dimension) {
  Bodies bodies;
  for (JointedBody& body : bodies) {
    body.about = random_vector(random, dimension);
    body = moved(
        body, (Rate() << random_vector(random, dimension), 0.4 * random_vector(random, dimension, true)).finished(), 1);
  }
  return bodies;
}

std::vector<JointRow> all_rows(const JointSpec& spec, int dimension, const Bodies& bodies) {
  const JointFrames frames = joint_frames(spec, dimension);
  std::vector<JointRow> rows = joint_constraints(spec.kind, dimension, frames, bodies[0], bodies[1]);
  if (coordinate_of(spec.kind) != JointCoordinate::none)
    rows.push_back(joint_coordinate(spec.kind, frames, bodies[0], bodies[1]));
  return rows;
}

// Moves the second body so that the anchors of a joint of one point meet: rates are exact there.
Bodies closed(const JointSpec& spec, int dimension, Bodies bodies) {
  using K = JointKind;
  if (spec.kind != K::weld && spec.kind != K::hinge && spec.kind != K::ball && spec.kind != K::universal) return bodies;
  const JointFrames frames = joint_frames(spec, dimension);
  const Vec3 gap = bodies[0].pose.apply(frames.first.anchor) - bodies[1].pose.apply(frames.second.anchor);
  bodies[1].pose.displacement += gap;
  bodies[1].about += gap;
  return bodies;
}

bool turns_out_of_plane(JointKind kind) {
  return kind == JointKind::hinge;
}

}  // namespace

// Central differences of the values, with open joints but for points. A hinge's angle has its rate where the axes agree
// only.
TEST_CASE("joints: rates of constraints and coordinates are derivatives of their values", "[joint]") {
  for (const int dimension : {2, 3})
    for (const JointKindRow& kind : joint_kinds()) {
      if (kind.kind == JointKind::gear) continue;
      std::mt19937 random(3);
      const JointSpec spec = spec_of(kind.kind, dimension);
      const Bodies bodies = closed(spec, dimension, random_bodies(random, dimension));
      Rate a, b;
      a << random_vector(random, dimension), random_vector(random, dimension, true);
      b << random_vector(random, dimension), random_vector(random, dimension, true);
      constexpr double dt = 1e-4;
      const auto rows = all_rows(spec, dimension, bodies);
      const auto before = all_rows(spec, dimension, {moved(bodies[0], a, -dt), moved(bodies[1], b, -dt)});
      const auto after = all_rows(spec, dimension, {moved(bodies[0], a, dt), moved(bodies[1], b, dt)});
      const std::size_t exact = rows.size() - (dimension == 3 && turns_out_of_plane(kind.kind) ? 1 : 0);
      for (std::size_t i = 0; i < exact; ++i) {
        CAPTURE(dimension, kind.name, i);
        const double rate = rows[i].first.dot(a) + rows[i].second.dot(b);
        CHECK(rate == Approx((after[i].value - before[i].value) / (2 * dt)).margin(1e-7));  // truncation dt^2
      }
    }
}

TEST_CASE("joints: loads along constraints keep linear and angular momentum", "[joint]") {
  for (const int dimension : {2, 3})
    for (const JointKindRow& kind : joint_kinds()) {
      if (kind.kind == JointKind::gear) continue;
      std::mt19937 random(4);
      const Bodies bodies = random_bodies(random, dimension);
      for (const JointRow& row : all_rows(spec_of(kind.kind, dimension), dimension, bodies)) {
        CAPTURE(dimension, kind.name);
        const Vec3 force = row.first.head<3>() + row.second.head<3>();
        const Vec3 torque = row.first.tail<3>() + bodies[0].about.cross(row.first.head<3>()) + row.second.tail<3>() +
                            bodies[1].about.cross(row.second.head<3>());
        CHECK(force.norm() <= 1e-15);
        CHECK(torque.norm() <= 1e-14);
      }
    }
}

TEST_CASE("joints: closed where the solids are at the start", "[joint]") {
  for (const int dimension : {2, 3})
    for (const JointKindRow& kind : joint_kinds()) {
      if (kind.kind == JointKind::gear) continue;
      const JointSpec spec = spec_of(kind.kind, dimension);
      const JointFrames frames = joint_frames(spec, dimension);
      CAPTURE(dimension, kind.name);
      for (const JointRow& row : joint_constraints(kind.kind, dimension, frames, {}, {}))
        CHECK(std::abs(row.value) <= 1e-15);
      CHECK((frames.first.axes.transpose() * frames.first.axes).isIdentity(1e-14));
    }
}

TEST_CASE("joints: a capped force is the derivative of its energy and stops at its cap", "[joint]") {
  const CappedForce force{3, 0.5, 0.6};
  constexpr double h = 1e-6;
  for (const double r : {-2.0, 0.31, 0.4, 0.6, 0.69, 3.0}) {
    CHECK(-force.impulse(r) == Approx((force.energy(r + h) - force.energy(r - h)) / (2 * h)).margin(1e-8));
    CHECK(force.curvature(r) == Approx((force.impulse(r - h) - force.impulse(r + h)) / (2 * h)).margin(1e-8));
    CHECK(std::abs(force.impulse(r)) <= 0.6);
  }
  CHECK(force.impulse(-10) == 0.6);
  CHECK(force.impulse(0.5) == 0);
}

}  // namespace joint_tests
