// The search for close pairs finds each pair once, for a thousand bodies, with the same bits each time.
#include <random>

#include "solid/contact/search.h"
#include "unit/solid/contact_cases.h"

namespace contact_search_tests {
using namespace seiche;
using namespace seiche::contact_cases;

namespace {

// A lattice of boxes and balls (2D: hexagons), slightly displaced and rotated.
template <int Dim>
DryWorld<Dim> lattice(int side, unsigned seed) {
  std::mt19937 engine(seed);
  const auto random = [&](double size) { return std::uniform_real_distribution<>(-size, size)(engine); };
  DryWorld<Dim> world;
  world.gravity = Vec3(0, -9.81, 0);
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  for (int i = 0; i < std::pow(side, Dim); ++i) {
    Vec3 center = 0.12 * Vec3(i % side + 0.5, i / side % side + 0.5, Dim == 2 ? 0 : i / (side * side) + 0.5);
    center.head<Dim>() += Vec3(random(0.01), random(0.01), random(0.01)).head<Dim>();
    if (i % 2) {
      world.add(Dim == 2 ? polygon(0.045, 6) : icosphere(0.045, 1), center, 0.4, Vec3::Constant(3e-4));
    } else {
      world.add_box(Vec3::Constant(0.07), center, 1000);
    }
    world.bodies.back().contact.friction = 0.3;
    world.bodies.back().pose.rotation = Eigen::AngleAxisd(random(0.5), Vec3::UnitZ()).toRotationMatrix();
  }
  return world;
}

template <int Dim>
contact::Points<Dim> points_of(DryWorld<Dim>& world, double way) {
  const auto& scene = world.scene().data();
  std::vector<ContactMotion> motions;
  for (const auto& b : world.bodies) motions.push_back({b.pose, b.pose});
  const auto interval = contact::make_interval<Dim>(scene, motions, 1);
  auto velocities = contact::all_velocities<Dim>(scene, interval, Eigen::VectorXd::Zero(scene.size), 0);
  for (size_t b = 0; b < velocities.twists.size(); ++b) velocities.twists[b].setConstant(way * (b % 3 - 1.));
  return contact::place<Dim>(scene, interval, velocities).points;
}

using Key = std::tuple<char, std::array<int, 4>>;

// Pairs closer than `margin` among the given ones; each must be there once.
template <int Dim>
std::vector<Key> near(const typename ContactScene<Dim>::Data& scene, const std::vector<contact::Candidate>& pairs,
                      const contact::Points<Dim>& points, double margin) {
  std::vector<Key> list;
  for (const contact::Candidate& c : pairs)
    if (c.kind != contact::PairKind::point_wall &&
        contact::separate<Dim>(scene, c, contact::gather<Dim>(c, points)).distance < margin)
      list.emplace_back(static_cast<char>(c.kind), c.points);
  std::sort(list.begin(), list.end());
  return list;
}

template <int Dim>
std::vector<contact::Candidate> all_pairs(const typename ContactScene<Dim>::Data& scene) {
  std::vector<contact::Candidate> list;
  const int count = static_cast<int>(scene.surfaces.size());
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      const auto &one = scene.surfaces[a], &two = scene.surfaces[b];
      const int start = scene.point_begin[a], other = scene.point_begin[b];
      if (a == b) continue;
      for (int p = 0; p < static_cast<int>(one.points.size()); ++p)
        for (const auto& e : two.elements) {
          contact::Candidate c{contact::PairKind::point_element, a, b, {start + p, 0, 0, 0}};
          for (int k = 0; k < Dim; ++k) c.points[k + 1] = other + e[k];
          list.push_back(c);
        }
      for (const auto& e : one.edges)
        for (const auto& f : two.edges)
          if (a < b)
            list.push_back(
                {contact::PairKind::edge_edge, a, b, {start + e[0], start + e[1], other + f[0], other + f[1]}});
    }
  return list;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the search finds each near pair once, at both ends of the way", "", ((int Dim), Dim), 2, 3) {
  DryWorld<Dim> world = lattice<Dim>(Dim == 2 ? 4 : 2, 5);
  const auto& scene = world.scene().data();
  const double margin = 0.04;
  const auto from = points_of<Dim>(world, 0), to = points_of<Dim>(world, 0.03);
  const auto found = contact::find_candidates<Dim>(scene, from, to, margin);
  const auto all = all_pairs<Dim>(scene);
  for (const auto& points : {from, to}) {
    const auto expected = near<Dim>(scene, all, points, margin);
    CHECK(expected.size() > 20);
    CHECK(near<Dim>(scene, found, points, margin) == expected);
  }
  CHECK(found.size() < all.size());
}

TEST_CASE("a thousand bodies fall without touching what they should not") {
  DryWorld<3> world = lattice<3>(10, 1);
  std::vector<ContactMotion> motions;
  for (int i = 0; i < 6; ++i) world.step(0.01);
  for (const auto& b : world.bodies) motions.push_back({b.pose, b.pose});
  CHECK(find_initial_overlaps<3>(world.scene(), motions, 1e-9).empty());
  CHECK(world.report.active > 10);
}

TEST_CASE("the same input gives the same bits") {
  DryWorld<3> one = lattice<3>(3, 2), two = lattice<3>(3, 2);
  for (int i = 0; i < 10; ++i) {
    one.step(0.01);
    two.step(0.01);
    REQUIRE(one.report.velocity == two.report.velocity);
  }
  CHECK(one.report.active > 10);
}

}  // namespace contact_search_tests
