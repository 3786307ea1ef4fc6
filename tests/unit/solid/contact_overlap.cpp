// Initial overlaps: close, crossing and contained bodies, inverted containers, walls, empty surfaces.
#include "unit/solid/contact_cases.h"

namespace contact_overlap_tests {
using namespace seiche;
using namespace seiche::contact_cases;

namespace {

constexpr double clearance = 1e-6;

template <int Dim>
std::vector<Overlap> overlaps(DryWorld<Dim>& world) {
  std::vector<ContactMotion> motions;
  for (const auto& b : world.bodies) motions.push_back({b.pose, b.pose});
  return find_initial_overlaps<Dim>(world.scene(), motions, clearance);
}

// A unit box about the origin and a smaller one at `center`, turned by 0.1.
template <int Dim>
std::vector<Overlap> two_boxes(const Vec3& center, double size, double turn = 0.1) {
  DryWorld<Dim> world;
  world.add_box(Vec3::Ones(), Vec3::Zero(), 1).contact.name = "big";
  auto& small = world.add_box(Vec3::Constant(size), center, 1);
  small.contact.name = "small";
  small.pose.rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  return overlaps<Dim>(world);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("overlaps of two boxes", "", ((int Dim), Dim), 2, 3) {
  CHECK(two_boxes<Dim>(Vec3(0.8, 0, 0), 0.5).empty());
  CHECK(two_boxes<Dim>(Vec3(0.75 + 2e-6, 0, 0), 0.5, 0).empty());
  const auto near = two_boxes<Dim>(Vec3(0.75 + 5e-7, 0, 0), 0.5, 0);
  REQUIRE(near.size() == 1);
  CHECK(near[0].depth == Approx(-5e-7).epsilon(1e-6));
  CHECK(near[0].message == "big and small are 5e-07 m apart, nearer than 1e-06 m");
  const auto by_a_hair = two_boxes<Dim>(Vec3(0.75 - 1e-9, 0, 0), 0.5, 0);
  REQUIRE(by_a_hair.size() == 1);
  const auto crossing = two_boxes<Dim>(Vec3(0.7, 0, 0), 0.5);
  REQUIRE(crossing.size() == 1);
  const double corner = 0.25 * (std::cos(0.1) + std::sin(0.1));  // reach of the rotated corner
  CHECK(crossing[0].depth == Approx(0.5 - 0.7 + corner));
  const auto inside = two_boxes<Dim>(Vec3(0.1, 0, 0), 0.5);
  REQUIRE(inside.size() == 1);
  CHECK(inside[0].depth > 0.2);
  CHECK(inside[0].message.rfind("big and small overlap by", 0) == 0);
}

TEMPLATE_TEST_CASE_SIG("a container is a solid that lies outside its surface", "", ((int Dim), Dim), 2, 3) {
  const auto with_box_at = [](const Vec3& center) {
    DryWorld<Dim> world;
    auto& container = world.add(inverted(box<Dim>(Vec3::Ones())), Vec3::Zero(), 0, Vec3::Ones());
    container.contact.control = BodyControl::prescribed;
    world.add_box(Vec3::Constant(0.2), center, 1);
    return overlaps<Dim>(world);
  };
  CHECK(with_box_at(Vec3(0.3, 0.2, 0)).empty());
  CHECK(with_box_at(Vec3(0.45, 0.2, 0)).size() == 1);
  const auto outside = with_box_at(Vec3(1, 0.2, 0));
  REQUIRE(outside.size() == 1);
  CHECK(outside[0].body == 1);
  CHECK(outside[0].other == 0);
  CHECK(outside[0].depth == Approx(0.6));
}

TEST_CASE("crossed bars overlap though neither has a corner in the other") {
  DryWorld<3> world;
  world.add_box(Vec3(1, 0.1, 0.1), Vec3::Zero(), 1);
  world.add_box(Vec3(0.1, 1, 0.05), Vec3(0.01, 0.02, 0.01), 1);
  CHECK(overlaps<3>(world).size() == 1);
}

TEMPLATE_TEST_CASE_SIG("overlaps with walls, and none of bodies without a surface", "", ((int Dim), Dim), 2, 3) {
  DryWorld<Dim> world;
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.add_box(Vec3::Ones(), Vec3(0, 0.4, 0), 1);
  world.add(SurfaceMesh{}, Vec3::Zero(), 1, Vec3::Ones());
  world.add_box(Vec3::Ones(), Vec3(5, 0.6, 0), 1);
  const auto list = overlaps<Dim>(world);
  REQUIRE(list.size() == 1);
  CHECK(list[0].with == Overlap::With::wall);
  CHECK(list[0].depth == Approx(0.1));
  world.bodies[0].pose.displacement[1] = 0.6;
  world.step(0.01);  // a body without a surface is harmless
  CHECK(world.report.active == 0);
}

TEST_CASE("a surface whose points do not exist is refused") {
  SurfaceMesh broken = box<3>(Vec3::Ones());
  broken.triangles[3][1] = 8;
  CHECK_THROWS_WITH(ContactScene<3>({{broken, BodyControl::free, 1, {}, "rock"}}, {}),
                    "rock: its surface uses point 8, but there is no such point");
}

}  // namespace contact_overlap_tests
