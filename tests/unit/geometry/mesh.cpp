// Mesh files: every format gives the same surface; faults are repaired with a note or rejected with their position.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "unit/geometry/mesh_files.h"

namespace mesh_tests {
using namespace seiche;
using namespace seiche::mesh_files;

namespace {

SurfaceMesh read(const TemporaryFolder& folder, const std::string& name, const std::string& bytes,
                 std::vector<std::string>* notes = nullptr) {
  std::vector<std::string> own;
  return read_closed_mesh(folder.write(name, bytes), notes ? *notes : own);
}

std::string refusal_of_file(const std::filesystem::path& file) {
  try {
    std::vector<std::string> notes;
    read_closed_mesh(file, notes);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    const std::string message = e.what();
    CHECK(std::count(message.begin(), message.end(), '\n') < 2);
    return message;
  }
  return "";
}

std::string refusal(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  return refusal_of_file(folder.write(name, bytes));
}

}  // namespace

TEST_CASE("all formats give the same closed surface") {
  const TemporaryFolder folder;
  const SurfaceMesh ball = sphere(Vec3(0.5, -0.25, 2), 0.75, 2);
  const std::vector<std::pair<std::string, std::string>> files{{"ball.obj", obj(ball)},
                                                               {"BALL.OBJ", relative_obj(ball)},
                                                               {"ball.ply", binary_ply(ball, "little")},
                                                               {"big.ply", binary_ply(ball, "big")},
                                                               {"text.ply", ascii_ply(ball)},
                                                               {"text.stl", ascii_stl(ball)},
                                                               {"binary.stl", binary_stl(ball)},
                                                               {"other.stl", binary_stl(ball, "exported")}};
  for (const auto& [name, bytes] : files) {
    CAPTURE(name);
    std::vector<std::string> notes;
    const SurfaceMesh mesh = read(folder, name, bytes, &notes);
    CHECK(notes.empty());
    CHECK(mesh.points.size() == ball.points.size());  // STL repeats points; they are merged
    CHECK(mesh.triangles.size() == ball.triangles.size());
    CHECK(volume(mesh) == Approx(volume(ball)).epsilon(1e-6));  // float coordinates in STL
  }
}

TEST_CASE("polygons become fans of triangles") {
  const TemporaryFolder folder;
  std::string text = obj({cube().points, {}, {}});
  text += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const SurfaceMesh mesh = read(folder, "cube.obj", text);
  CHECK(mesh.triangles.size() == 12);
  CHECK(volume(mesh) == Approx(1));
}

// The last mesh is kept. It must not stand in for another one, for a changed file or for a refused one.
TEST_CASE("a mesh that is read again is the same, with its notes") {
  const TemporaryFolder folder;
  const SurfaceMesh ball = sphere(Vec3(0, 0, 0), 1, 1);
  SurfaceMesh twice = ball, open = ball;
  twice.triangles.push_back(ball.triangles[0]);
  open.triangles.pop_back();
  for (int round = 0; round < 2; ++round) {
    for (const char* name : {"a.obj", "b.obj"}) {
      std::vector<std::string> notes;
      CHECK(read(folder, name, obj(twice), &notes).triangles.size() == ball.triangles.size());
      REQUIRE(notes.size() == 1);
      CHECK_THAT(notes[0], Catch::Contains(name));
    }
    CHECK(refusal(folder, "a.obj", obj(open)) != "");
    CHECK(read(folder, "a.obj", obj(cube())).triangles.size() == 12);
  }
}

TEST_CASE("missing, empty, foreign and unfetched files are refused by name") {
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of_file(folder / "none.obj"), Catch::Contains("none.obj") && Catch::Contains("No such file"));
  CHECK_THAT(refusal(folder, "empty.ply", ""), Catch::Contains("0 bytes"));
  CHECK_THAT(refusal(folder, "blank.obj", "\n\n"), Catch::Contains("no faces"));
  std::filesystem::create_directory(folder / "dir.obj");
  CHECK_THAT(refusal_of_file(folder / "dir.obj"), Catch::Contains("folder"));
  CHECK_THAT(refusal(folder, "cube.vtk", obj(cube())), Catch::Contains(".obj, .ply or .stl"));
  CHECK_THAT(refusal(folder, "cube.obj", binary_ply(cube(), "little")), Catch::Contains("PLY"));
  CHECK_THAT(refusal(folder, "cube.obj", binary_stl(cube(), "exported")), Catch::Contains("STL"));
  CHECK_THAT(refusal(folder, "cube.obj", ascii_stl(cube())), Catch::Contains("STL"));
  CHECK_THAT(refusal(folder, "cube.ply", obj(cube())), Catch::Contains("PLY"));
  CHECK_THAT(refusal(folder, "cube.stl", obj(cube())), Catch::Contains("cube.stl"));
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a21\nsize 12345\n";
  for (const char* name : {"lfs.obj", "lfs.ply", "lfs.stl"}) {
    CHECK_THAT(refusal(folder, name, pointer), Catch::Contains("git lfs pull"));
  }
}

TEST_CASE("a file cut anywhere is refused, never read as less") {
  const TemporaryFolder folder;
  const SurfaceMesh ball = sphere(Vec3(0, 0, 0), 1, 1);
  const std::vector<std::pair<std::string, std::string>> files{{"cut.obj", obj(ball)},
                                                               {"cut.ply", binary_ply(ball, "little")},
                                                               {"cut_text.ply", ascii_ply(ball)},
                                                               {"cut_text.stl", ascii_stl(ball)},
                                                               {"cut.stl", binary_stl(ball, "exported")}};
  for (const auto& [name, bytes] : files) {
    for (int twentieth = 1; twentieth < 20; ++twentieth) {
      CAPTURE(name, twentieth);
      CHECK(refusal(folder, name, bytes.substr(0, bytes.size() * twentieth / 20)) != "");
    }
  }
}

TEST_CASE("counts larger than the file are refused before anything is allocated") {
  const TemporaryFolder folder;
  std::string stl = binary_stl(cube(), "exported");
  const std::uint32_t huge = 4294967295u;
  std::memcpy(&stl[80], &huge, 4);
  CHECK_THAT(refusal(folder, "huge.stl", stl), Catch::Contains("byte 80") && Catch::Contains("4294967295 triangles"));
  const std::string faces = ply_header({{}, {}, {}}, "binary_little_endian", "4294967296");
  CHECK_THAT(refusal(folder, "huge.ply", faces), Catch::Contains("4294967296") && Catch::Contains("byte"));
  const std::string text = ply_header({{}, {}, {}}, "ascii", "18446744073709551616");
  CHECK_THAT(refusal(folder, "huge.ply", text), Catch::Contains("huge.ply:9: "));
  std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
      "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  put(list, huge, false);
  CHECK_THAT(refusal(folder, "list.ply", list), Catch::Contains("list"));
}

TEST_CASE("indices and coordinates out of range are refused with their line or byte") {
  const TemporaryFolder folder;
  const std::string points = obj({cube().points, {}, {}});  // 10 lines
  CHECK_THAT(refusal(folder, "a.obj", points + "f 1 2 9\n"),
             Catch::Contains("a.obj:11: ") && Catch::Contains("point 9"));
  CHECK_THAT(refusal(folder, "a.obj", points + "f 1 2 0\n"), Catch::Contains("a.obj:11: "));
  CHECK_THAT(refusal(folder, "a.obj", points + "f 1 2 -9\n"), Catch::Contains("a.obj:11: "));
  CHECK_THAT(refusal(folder, "a.obj", points + "f 1 2 99999999999999999999\n"), Catch::Contains("a.obj:11: "));
  CHECK_THAT(refusal(folder, "a.obj", points + "f 1 2\n"), Catch::Contains("a.obj:11: "));
  CHECK_THAT(refusal(folder, "a.obj", "v 0 nan 0\n"), Catch::Contains("a.obj:1: ") && Catch::Contains("nan"));
  CHECK_THAT(refusal(folder, "a.obj", "v 0 1e999 0\n"), Catch::Contains("1e999"));
  CHECK_THAT(refusal(folder, "a.obj", "v 0 0,5 0\n"), Catch::Contains("0,5"));
  CHECK_THAT(refusal(folder, "a.obj", "hello\n"), Catch::Contains("a.obj:1: "));
  SurfaceMesh bad = cube();
  bad.triangles[3][1] = 8;
  CHECK_THAT(refusal(folder, "b.ply", binary_ply(bad, "big")), Catch::Contains("byte") && Catch::Contains("point 8"));
  CHECK_THAT(refusal(folder, "b.ply", ascii_ply(bad)), Catch::Contains("b.ply:") && Catch::Contains("point 8"));
  bad.triangles[3][1] = -1;
  CHECK_THAT(refusal(folder, "b.ply", binary_ply(bad, "little")), Catch::Contains("point -1"));
  bad = cube();
  bad.points[2][1] = NAN;
  CHECK_THAT(refusal(folder, "c.ply", binary_ply(bad, "little")), Catch::Contains("point 2"));
  CHECK_THAT(refusal(folder, "c.stl", binary_stl(bad, "exported")), Catch::Contains("not finite"));
  CHECK_THAT(refusal(folder, "c.stl", ascii_stl(bad)), Catch::Contains("nan"));
}

TEST_CASE("open edges are refused with their count and place") {
  const TemporaryFolder folder;
  SurfaceMesh open = cube();
  open.triangles.pop_back();
  CHECK_THAT(refusal(folder, "open.obj", obj(open)), Catch::Contains("3 open edges") && Catch::Contains("(1, 1, 0)"));
  SurfaceMesh many = sphere(Vec3(0, 0, 0), 1, 2);
  for (const int t : {100, 50, 10}) many.triangles.erase(many.triangles.begin() + t);
  CHECK_THAT(refusal(folder, "many.obj", obj(many)), Catch::Contains("9 open edges") && Catch::Contains("..."));
}

TEST_CASE("edges of more than two triangles are refused with their count and place") {
  const TemporaryFolder folder;
  const SurfaceMesh touching = joined(cube(), cube(Vec3(1, 1, 0)));
  CHECK_THAT(refusal(folder, "touching.obj", obj(touching)),
             Catch::Contains("1 edges with more than two") && Catch::Contains("(1, 1, 0) to (1, 1, 1)"));
}

TEST_CASE("surfaces with one side or no volume are refused") {
  const TemporaryFolder folder;
  // The projective plane with six points; each edge is in two triangles.
  SurfaceMesh one_sided;
  for (int i = 0; i < 6; ++i) one_sided.points.push_back(Vec3(std::cos(i), std::sin(2.0 * i), 0.3 * i * i));
  one_sided.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                         {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  CHECK_THAT(refusal(folder, "one_sided.obj", obj(one_sided)), Catch::Contains("one side"));
  SurfaceMesh flat = cube();
  for (Vec3& p : flat.points) p[2] *= 1e-16;
  CHECK(refusal(folder, "flat.obj", obj(flat)) != "");
}

TEST_CASE("triangles that face the wrong way are turned, with a note") {
  const TemporaryFolder folder;
  SurfaceMesh some = sphere(Vec3(3, 3, 3), 1, 2), all = some;
  const double expected = volume(some);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    std::swap(all.triangles[t][0], all.triangles[t][1]);
    if (t % 5 == 0) std::swap(some.triangles[t][0], some.triangles[t][1]);
  }
  for (const SurfaceMesh& mesh : {some, all}) {
    std::vector<std::string> notes;
    CHECK(volume(read(folder, "turned.obj", obj(mesh), &notes)) == Approx(expected));
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("turned.obj") && Catch::Contains("to face outwards"));
  }
}

TEST_CASE("duplicate and degenerate triangles are dropped, with a note") {
  const TemporaryFolder folder;
  SurfaceMesh mesh = cube();
  mesh.triangles.push_back(mesh.triangles[4]);
  mesh.triangles.push_back({3, 2, 1});  // as the second one, reversed
  mesh.triangles.push_back({5, 5, 6});
  std::vector<std::string> notes;
  CHECK(read(folder, "messy.obj", obj(mesh), &notes).triangles.size() == 12);
  REQUIRE(notes.size() == 2);
  CHECK_THAT(notes[0], Catch::Contains("1 degenerate"));
  CHECK_THAT(notes[1], Catch::Contains("2 duplicate"));
}

TEST_CASE("triangles on a line close the surface and are then dropped") {
  const TemporaryFolder folder;
  SurfaceMesh mesh = cube();
  mesh.points.push_back(Vec3(0.5, 0, 0));  // the edge 0-1 is whole in one face and split in the other one
  mesh.triangles[4] = {0, 8, 4};
  mesh.triangles.push_back({8, 1, 4});
  mesh.triangles.push_back({0, 1, 8});
  std::vector<std::string> notes;
  const SurfaceMesh read_mesh = read(folder, "split.obj", obj(mesh), &notes);
  CHECK(read_mesh.triangles.size() == 13);
  CHECK(volume(read_mesh) == Approx(1));
  CHECK_THAT(notes.at(0), Catch::Contains("1 triangles without area"));
}

}  // namespace mesh_tests
