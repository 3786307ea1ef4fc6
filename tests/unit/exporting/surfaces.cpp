// Closed surfaces of the liquid, and solids and axes as exports have them.
#include <catch2/catch.hpp>

#include <map>

#include "../files/scratch.h"
#include "base/error.h"
#include "base/scene.h"
#include "exporting/axes.h"
#include "exporting/bodies.h"
#include "exporting/liquid.h"
#include "geometry/vdb/closing.h"

namespace exporting_surfaces_tests {
using namespace seiche;
using namespace seiche::exporting;

namespace {

constexpr double h = 0.1;

// Cells of a frame with phi(x) at their centres and velocity u(x) at their faces.
template <class Phi, class Velocity>
vdb::Frame frame_of(const std::array<int, 3>& cells, const Phi& phi, const Velocity& u) {
  vdb::Frame frame;
  frame.cell_size = h;
  frame.lower = {-0.3, 0.2, 1};
  vdb::Block distances{{0, 0, 0}, cells, {}}, vectors{{0, 0, 0}, cells, {}};
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        const Vec3 corner = frame.lower + h * Vec3(i, j, k), center = corner + Vec3::Constant(h / 2);
        distances.values.push_back(float(std::clamp(phi(center), -3 * h, 3 * h)));
        for (int a = 0; a < 3; ++a) {
          Vec3 face = center;
          face[a] = corner[a];
          vectors.values.push_back(float(phi(center) < 3 * h ? u(face)[a] : 1e6));  // far outside: no velocity
        }
      }
  frame.grids.push_back({"surface", vdb::GridKind::level_set, float(3 * h), {distances}, true});
  frame.grids.push_back({"vel", vdb::GridKind::staggered_vector, 0, {vectors}});
  return frame;
}

bool is_closed(const SurfaceMesh& mesh) {
  std::map<std::array<int, 2>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      ++uses[{t[c], t[(c + 1) % 3]}];
      --uses[{t[(c + 1) % 3], t[c]}];
    }
  return std::ranges::all_of(uses, [](const auto& use) { return use.second == 0; });
}

double volume_within(const SurfaceMesh& mesh) {
  double six = 0;
  const auto& p = mesh.points;
  for (const auto& t : mesh.triangles)
    six += p[std::size_t(t[0])].dot(p[std::size_t(t[1])].cross(p[std::size_t(t[2])]));
  return six / 6;
}

Vec3 shear(const Vec3& x) {
  return {1 + 2 * x[1], x[2] - x[0], 3 * x[0]};
}

}  // namespace

TEST_CASE("Liquid that fills its domain is a closed box", "[exporting]") {
  const vdb::Frame frame = frame_of(
      {7, 4, 5}, [](const Vec3&) { return -1.0; }, shear);
  const AttributedMesh liquid = liquid_mesh(frame);
  CHECK(is_closed(liquid.mesh));
  CHECK(volume_within(liquid.mesh) == Approx(7 * 4 * 5 * h * h * h).epsilon(1e-12));
  for (const Vec3& x : liquid.mesh.points) {
    CHECK((x - frame.lower).minCoeff() > -1e-6);
    CHECK((frame.lower + h * Vec3(7, 4, 5) - x).minCoeff() > -1e-6);
  }
}

TEST_CASE("A pool with a wave is closed below, with the velocity of the liquid at its points", "[exporting]") {
  const auto pool = [](const Vec3& x) { return x[1] - 0.55 - 0.1 * std::sin(8 * x[0]); };
  const AttributedMesh liquid = liquid_mesh(frame_of({12, 8, 6}, pool, shear));
  CHECK(is_closed(liquid.mesh));
  REQUIRE(liquid.attributes.size() == 1);
  CHECK(liquid.attributes[0].name == "velocity");
  double worst = 0;
  for (std::size_t n = 0; n < liquid.mesh.points.size(); ++n)
    for (int a = 0; a < 3; ++a)
      worst = std::max(worst,
                       std::abs(liquid.attributes[0].values[3 * n + std::size_t(a)] - shear(liquid.mesh.points[n])[a]));
  // Linear flow is exact between samples; beyond the outermost ones a point is half a cell from them, and a point that
  // wet samples surround in part is up to a cell from their mean: 3 1/s times a cell.
  CHECK(worst < 3 * h);
}

TEST_CASE("A level set closed at the sides keeps its distance within and beyond them", "[exporting]") {
  vdb::Block block{{0, 0, 0}, {4, 4, 1}, std::vector<float>(16, -10.0f)};
  const vdb::Block closed = vdb::closed_at_sides(block, {4, 4, 1}, 2, h);
  CHECK(closed.lower == std::array{-3, -3, 0});
  CHECK(closed.upper == std::array{7, 7, 1});
  const auto at = [&](int i, int j) { return closed.values[std::size_t((j + 3) * 10 + i + 3)]; };
  CHECK(at(0, 1) == Approx(-h / 2));
  CHECK(at(1, 1) == Approx(-1.5 * h));
  CHECK(at(-1, 2) == Approx(h / 2));
  CHECK(at(-1, -2) == Approx(h * std::hypot(0.5, 1.5)));
  const vdb::Block inner{{1, 1, 0}, {3, 3, 1}, std::vector<float>(4, -10.0f)};
  CHECK(vdb::closed_at_sides(inner, {4, 4, 1}, 2, h).upper == inner.upper);
}

TEST_CASE("A frame without a surface exports no liquid", "[exporting]") {
  vdb::Frame frame = frame_of(
      {3, 3, 3}, [](const Vec3&) { return -1.0; }, shear);
  frame.grids.erase(frame.grids.begin());
  CHECK_THROWS_WITH(liquid_mesh(frame), Catch::Contains("holds no surface"));
}

TEST_CASE("Solids of a frame are told apart, each with its own points", "[exporting]") {
  render::SolidMesh all;
  for (int n = 0; n < 7; ++n) all.mesh.points.emplace_back(n, 0, 0);
  all.mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {4, 5, 6}};
  all.solid = {2, 0, 0};
  const std::vector<SurfaceMesh> parts = split(all, 3);
  CHECK(parts[0].points.size() == 4);
  CHECK(parts[0].triangles == std::vector<std::array<int, 3>>{{0, 1, 2}, {1, 2, 3}});
  CHECK(parts[1].points.empty());
  CHECK(parts[2].points[2] == Vec3(2, 0, 0));
}

TEST_CASE("Poses are read by time and name, and faults of the table name its line", "[exporting]") {
  const ScratchFolder scratch;
  const std::string head = "time,name,x,y,z,qw,qx,qy,qz\n";
  const auto file = scratch.write("solids.csv", head + "0,a,1,2,3,1,0,0,0\n0,b,4,5,6,1,0,0,0\n0.5,a,1,2,9,0,1,0,0\n");
  const PoseTable poses(file, {"a", "b"});
  CHECK(poses.at(0, 0.5).position == Vec3(1, 2, 9));
  CHECK(poses.at(0, 0.5).orientation.x() == 1);
  CHECK(poses.at(1, 0).position == Vec3(4, 5, 6));
  CHECK_THROWS_WITH(poses.at(1, 0.5), Catch::Contains("no row of 'b' at t = 0.5 s"));
  const auto bad = scratch.write("bad.csv", head + "0,a,1,2,3,1,0,0,0\n0,a,1,2\n");
  CHECK_THROWS_WITH(PoseTable(bad, {"a"}), Catch::Contains("bad.csv:3"));
  CHECK_THROWS_WITH(PoseTable(scratch.write("other.csv", "time,name\n"), {"a"}), Catch::Contains("no column 'x'"));
  CHECK_THROWS_WITH(PoseTable(scratch / "none.csv", {"a"}), Catch::Contains("cannot be read"));
}

TEST_CASE("Axes turn by quarters: up goes up, poses and vectors with it", "[exporting]") {
  Scene scene;
  CHECK(up_of(scene) == Vec3::UnitY());
  scene.gravity.formula = {"0", "0", "-9.81"};
  CHECK(up_of(scene) == Vec3::UnitZ());
  const Turn turn(Vec3::UnitY(), Vec3::UnitZ());
  CHECK(turn(Vec3(1, 2, 3)) == Vec3(1, -3, 2));
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const Pose pose{{4, 5, 6}, q}, turned = turn(pose);
  const Vec3 local(0.1, 0.2, 0.3);
  const Vec3 there = turned.position + turned.orientation * turn(local);
  CHECK((there - turn(pose.position + q * local)).norm() < 1e-14);
  AttributedMesh mesh{{{{1, 2, 3}}, {}, {}}, {{"velocity", 3, {1, 2, 3}}, {"pressure", 1, {7}}}};
  turn.apply(mesh);
  CHECK(mesh.attributes[0].values == std::vector<float>{1, -3, 2});
  CHECK(mesh.attributes[1].values == std::vector<float>{7});
}

}  // namespace exporting_surfaces_tests
