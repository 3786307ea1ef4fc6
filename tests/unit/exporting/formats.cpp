// Files of meshes, USD and XDMF.
#include <catch2/catch.hpp>

#include "../files/scratch.h"
#include "base/error.h"
#include "exporting/run.h"
#include "exporting/usd.h"
#include "exporting/xdmf.h"
#include "geometry/mesh/writers.h"

namespace exporting_formats_tests {
using namespace seiche;
using namespace seiche::exporting;

namespace {

SurfaceMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("PLY and OBJ files read back as the mesh that they hold", "[exporting]") {
  const ScratchFolder scratch;
  const std::vector<mesh::PointAttribute> attributes{{"velocity", 3, std::vector<float>(12, 2)},
                                                     {"pressure", 1, std::vector<float>(4, 7)}};
  std::vector<std::string> notes;
  const auto ply = scratch.write("t.ply", mesh::encode_ply(tetrahedron(), attributes, "a comment"));
  const auto obj = scratch.write("t.obj", mesh::encode_obj(tetrahedron(), "name", "a comment"));
  for (const auto& file : {ply, obj}) {
    const SurfaceMesh read = read_closed_mesh(file, notes);
    CHECK(read.points == tetrahedron().points);
    CHECK(read.triangles == tetrahedron().triangles);
  }
  CHECK(notes.empty());
  CHECK(count(contents(ply), "property float vy\n") == 1);
  CHECK(count(contents(ply), "property float pressure\n") == 1);
}

TEST_CASE("Names of prims are valid and unique", "[exporting]") {
  CHECK(prim_names({"a ball", "a_ball", "2", "", "gate"}) ==
        std::vector<std::string>{"a_ball", "a_ball_2", "_2", "_", "gate"});
}

TEST_CASE("A USD file lists a body once and its poses at all frames", "[exporting]") {
  const ScratchFolder scratch;
  {
    UsdWriter writer(scratch / "run.usda", {"a comment", "run", 3, 5, 24, 'Z'});
    writer.add_body("ball", tetrahedron(), {1, 0, 0});
    for (int frame = 3; frame <= 5; ++frame) {
      writer.add_pose("ball", frame, {{double(frame), 0, 0}, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5)});
      AttributedMesh liquid{tetrahedron(), {{"velocity", 3, std::vector<float>(12, 1)}}};
      if (frame == 5) liquid.mesh.triangles.pop_back();
      writer.add_sample("liquid", frame, liquid, {0, 0, 1});
    }
    writer.finish();
  }
  CHECK(entries(scratch.path()) == 1);  // no parts are left
  const std::string text = contents(scratch / "run.usda");
  CHECK(text.starts_with("#usda 1.0\n"));
  CHECK(count(text, "upAxis = \"Z\"") == 1);
  CHECK(count(text, "{") == count(text, "}"));
  CHECK(count(text, "(0, 1, 0, 0), (0, 0, 1, 0), (1, 0, 0, 0), (4, 0, 0, 1)") == 1);  // x to y to z, by rows
  CHECK(count(text, "faceVertexCounts.timeSamples") == 2);
  CHECK(count(text, ": [3, 3, 3, 3]") == 2);  // the body's, the liquid's where it changed
  CHECK(count(text, ": [3, 3, 3]") == 1);
  CHECK(count(text, "vector3f[] velocities.timeSamples") == 1);
  CHECK(count(text, "float3[] extent.timeSamples") == 2);
}

TEST_CASE("Parts of a USD file that was not finished are removed", "[exporting]") {
  const ScratchFolder scratch;
  { UsdWriter(scratch / "run.usda", {}).add_body("ball", tetrahedron(), {1, 0, 0}); }
  CHECK(entries(scratch.path()) == 0);
}

TEST_CASE("Values at nodes are means of the cells around", "[exporting]") {
  const std::vector<float> row{1, 3};
  CHECK(node_values(row, {2, 1, 1}, 2, 1) == std::vector<float>{1, 2, 3, 1, 2, 3});
  CHECK(node_values(row, {2, 1, 1}, 3, 1).size() == 12);
  CHECK(node_values({1, 2, 3, 5, 6, 7}, {2, 1, 1}, 2, 3)[4] == 4);  // the middle node's second component
}

TEST_CASE("Exporting refuses folders without frames", "[exporting]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(export_run({scratch.path(), {}, "ply"}, [](const std::string&) {}),
                    Catch::Contains("there are no frames"));
}

}  // namespace exporting_formats_tests
