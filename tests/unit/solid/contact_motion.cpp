// Collisions: no tunnelling, conserved momentum, prescribed bodies push, impacts do not bounce.
#include <random>

#include "solid/contact/path.h"
#include "unit/solid/contact_cases.h"

namespace contact_motion_tests {
using namespace seiche;
using namespace seiche::contact_cases;
using contact::PairKind;

namespace {

struct Random {
  std::mt19937 engine{11};
  double operator()(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine); }
  template <int Dim>
  Vec<Dim> vector(double size) {
    Vec<Dim> v;
    for (int i = 0; i < Dim; ++i) v[i] = (*this)(-size, size);
    return v;
  }
};

// Smallest distance of a pair between `from` and `to`, sampled.
template <int Dim>
double least_distance(PairKind kind, const contact::PairPoints<Dim>& from, const contact::PairPoints<Dim>& to,
                      double share) {
  double least = 1e300;
  for (int i = 0; i <= 2000; ++i) {
    contact::PairPoints<Dim> x = from;
    for (int k = 0; k < 4; ++k) x[k] += share * i / 2000. * (to[k] - from[k]);
    least = std::min(least, contact::separate<Dim>(kind, x).distance);
  }
  return least;
}

template <int Dim>
void check_random_pairs(PairKind kind) {
  Random random;
  const ContactScene<Dim> empty({}, {});
  int stopped = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    contact::PairPoints<Dim> from, to;
    for (int k = 0; k < 4; ++k) {
      from[k] = random.vector<Dim>(1);
      to[k] = from[k] + random.vector<Dim>(3);
    }
    const contact::Candidate pair{kind, 0, 1, {}};
    const double share = contact::pair_share<Dim>(empty.data(), pair, from, to, 0),
                 start = contact::separate<Dim>(kind, from).distance;
    REQUIRE(share > 0);
    REQUIRE(share <= 1);
    stopped += share < 1;
    REQUIRE(least_distance<Dim>(kind, from, to, share) >= 0.199 * start);  // a fifth of it is kept
  }
  CHECK(stopped > 100);
}

}  // namespace

TEST_CASE("no pair of primitives comes nearer than a fifth of its gap") {
  check_random_pairs<2>(PairKind::point_element);
  check_random_pairs<3>(PairKind::point_element);
  check_random_pairs<3>(PairKind::edge_edge);
}

TEST_CASE("distances of primitives are the least over all of their points") {
  Random random;
  for (int sample = 0; sample < 200; ++sample) {
    contact::PairPoints<3> x;
    for (Vec3& p : x) p = random.vector<3>(1);
    if (sample % 2) x[3] = x[2] + 0.7 * (x[1] - x[0]);  // parallel edges
    const double edges = contact::separate<3>(PairKind::edge_edge, x).distance;
    const double point = contact::separate<3>(PairKind::point_element, x).distance;
    double least_edges = 1e300, least_point = 1e300;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j) {
        const double s = i / 200., t = j / 200.;
        least_edges = std::min(least_edges, (x[0] + s * (x[1] - x[0]) - x[2] - t * (x[3] - x[2])).norm());
        if (s + t <= 1)
          least_point = std::min(least_point, (x[0] - x[1] - s * (x[2] - x[1]) - t * (x[3] - x[1])).norm());
      }
    REQUIRE(edges <= least_edges * (1 + 1e-14));
    REQUIRE(edges >= least_edges - 0.02);  // the samples are 1/200 of at most 3.5 apart
    REQUIRE(point <= least_point * (1 + 1e-14));
    REQUIRE(point >= least_point - 0.02);
  }
}

TEMPLATE_TEST_CASE_SIG("a thin plate at high speed does not pass another", "", ((int Dim), Dim), 2, 3) {
  DryWorld<Dim> world;
  world.add_box(Vec3(0.001, 1, 1), Vec3::Zero(), 1000);
  world.add_box(Vec3(0.001, 1, 1), Vec3(0.5, 0.02, 0.03), 1000);
  world.bodies[0].velocity[0] = 49;  // 490 times its thickness per step
  world.bodies[1].velocity.tail(1)[0] = 3;
  for (int i = 0; i < 5; ++i) {
    world.step(0.01);
    // Order along the normal of a plate, since the plates tilt.
    const Vec3 apart = world.bodies[1].pose.displacement - world.bodies[0].pose.displacement;
    CHECK(apart.dot(world.bodies[0].pose.rotation.col(0)) > 0.0009);
    CHECK(apart.dot(world.bodies[1].pose.rotation.col(0)) > 0.0009);
  }
  const double momentum = world.bodies[0].velocity[0] + world.bodies[1].velocity[0];
  CHECK(momentum == Approx(49).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG("a body that got round another in one step is reported", "", ((int Dim), Dim), 2, 3) {
  DryWorld<Dim> world;
  world.add_box(Vec3(0.001, 1, 1), Vec3::Zero(), 1000);
  world.add_box(Vec3(0.001, 1, 1), Vec3(0.5, 0.02, 0.03), 1000);
  world.bodies[0].velocity[0] = 1000;  // 10 m in the step
  world.step(0.01);
  const bool passed = world.bodies[1].pose.displacement[0] < world.bodies[0].pose.displacement[0];
  CHECK((!passed || world.report.straight_share < 1));
}

TEMPLATE_TEST_CASE_SIG("contact between free bodies keeps momentum", "", ((int Dim), Dim), 2, 3) {
  constexpr int n = twist_size<Dim>;
  DryWorld<Dim> world;
  for (int i = 0; i < 2; ++i) {
    auto& b = world.add_box(Vec3(0.1, 0.12, 0.09), Vec3(0.02 * i, 0.15 * i, Dim == 2 ? 0 : 0.01 * i), 1000 + 3000 * i);
    b.pose.rotation =
        Eigen::AngleAxisd(0.3 + i, Dim == 2 ? Vec3(0, 0, 1) : Vec3(1, 2, 3).normalized()).toRotationMatrix();
    b.contact.friction = 0.5;
    b.velocity[1] = 1 - 2 * i;
    b.velocity[n - 1] = 2 - 3 * i;
  }
  double largest = 0;
  for (int i = 0; i < 20; ++i) {
    const auto before = world.bodies;
    world.step(0.005);
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero(), change = Vec3::Zero();
    for (int b = 0; b < 2; ++b) {
      const BodyImpulse& impulse = world.report.impulses[b];
      linear += impulse.linear;
      angular += impulse.angular + world.bodies[b].pose.displacement.cross(impulse.linear);
      change += world.bodies[b].contact.mass *
                extend<Dim>((world.bodies[b].velocity - before[b].velocity).template head<Dim>());
      largest = std::max(largest, impulse.linear.norm());
    }
    CHECK(linear.norm() <= 1e-14 * largest);
    CHECK(angular.norm() <= 1e-14 * largest);  // lengths are below 1 m
    CHECK(change.norm() <= 1e-10 * largest);   // velocity changes, up to the round-off of stiff contacts
  }
  CHECK(largest > 0.5);
}

TEMPLATE_TEST_CASE_SIG("a prescribed piston pushes a row of boxes through many reaches", "", ((int Dim), Dim), 2, 3) {
  DryWorld<Dim> world;
  auto& piston = world.add_box(Vec3(0.02, 0.3, 0.3), Vec3::Zero(), 1);
  piston.contact.control = BodyControl::prescribed;
  for (int i = 0; i < 4; ++i) world.add_box(Vec3::Constant(0.1), Vec3(0.07 + 0.11 * i, 0.001 * i, 0), 100 * (1 + i));
  for (int i = 1; i <= 10; ++i) {
    Pose end = world.bodies[0].pose;
    end.displacement[0] += 0.05;  // fifty times the contact reach
    world.step(0.01, {{0, end}});
  }
  for (int b = 1; b < 5; ++b) {
    const double apart = world.bodies[b].pose.displacement[0] - world.bodies[b - 1].pose.displacement[0];
    CHECK(apart > (b == 1 ? 0.06 : 0.1));
    CHECK(apart < (b == 1 ? 0.06 : 0.1) + 0.06);
  }
}

TEMPLATE_TEST_CASE_SIG("a falling box comes to rest without a bounce", "", ((int Dim), Dim), 2, 3) {
  DryWorld<Dim> world;
  world.gravity = Vec3(0, -9.81, 0);
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.add_box(Vec3::Constant(0.1), Vec3(0, 0.3, 0), 1000);
  const double dt = 0.01;
  double fastest_up = 0, highest_after = 0;
  for (int i = 0; i < 200; ++i) {
    world.step(dt);
    const auto& b = world.bodies[0];
    fastest_up = std::max(fastest_up, b.velocity[1]);
    if (i > 40) highest_after = std::max(highest_after, b.pose.displacement[1]);
  }
  CHECK(fastest_up < world.options.reach / dt);
  CHECK(highest_after < 0.05 + 3 * world.options.reach);
  CHECK(std::abs(world.bodies[0].velocity[1]) < 1e-4);
}

TEST_CASE("the safe share of a motion ends before the collision") {
  DryWorld<3> world;
  world.add_box(Vec3::Ones(), Vec3::Zero(), 1);
  world.add_box(Vec3::Ones(), Vec3(3, 0, 0), 1);
  std::vector<ContactMotion> motions;
  for (const auto& b : world.bodies) motions.push_back({b.pose, b.pose});
  Eigen::VectorXd v = Eigen::VectorXd::Zero(12);
  CHECK(largest_safe_fraction<3>(world.scene(), motions, 0.1, v) == 1);
  v[0] = 40;  // 4 m, the gap is 2 m
  const double share = largest_safe_fraction<3>(world.scene(), motions, 0.1, v);
  CHECK(share <= 0.4);  // a fifth of the gap is kept
  CHECK(share > 0.38);
  v[3] = 20;  // rotating as well
  CHECK(largest_safe_fraction<3>(world.scene(), motions, 0.1, v) < 0.5);
}

}  // namespace contact_motion_tests
