// Mesh files: every format gives the same surface, faults are mended with a note or refused with their place.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "base/error.h"
#include "levelset/mesh_distance.h"
#include "levelset/shapes.h"

using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

struct TemporaryFolder {
  std::filesystem::path path;
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "seiche_mesh_XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return path / name;
  }
};

// ---- surfaces -------------------------------------------------------------------------------------------------

SurfaceMesh cube(const Vec3& lower = Vec3(0, 0, 0), double size = 1) {
  SurfaceMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back(lower + size * Vec3(i & 1, (i >> 1) & 1, i >> 2));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

SurfaceMesh subdivide(const SurfaceMesh& coarse, const Vec3& center, double radius) {
  SurfaceMesh fine{coarse.points, {}, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), int(fine.points.size()));
    if (is_new) {
      const Vec3 p = (fine.points[a] + fine.points[b]) / 2 - center;
      fine.points.push_back(center + radius * p.normalized());
    }
    return entry->second;
  };
  for (const auto& t : coarse.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    for (const auto& part : {std::array{t[0], a, c}, std::array{a, t[1], b}, std::array{c, b, t[2]}, std::array{a, b, c}}) {
      fine.triangles.push_back(part);
    }
  }
  return fine;
}

// An octahedron refined towards the sphere.
SurfaceMesh sphere(const Vec3& center, double radius, int refinements) {
  SurfaceMesh mesh;
  for (int a = 0; a < 3; ++a) {
    mesh.points.push_back(center - radius * Vec3::Unit(a));
    mesh.points.push_back(center + radius * Vec3::Unit(a));
  }
  for (int octant = 0; octant < 8; ++octant) {
    std::array<int, 3> t{octant & 1, 2 + ((octant >> 1) & 1), 4 + (octant >> 2)};
    if (((octant & 1) + ((octant >> 1) & 1) + (octant >> 2)) % 2 == 0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  for (int i = 0; i < refinements; ++i) mesh = subdivide(mesh, center, radius);
  return mesh;
}

SurfaceMesh joined(SurfaceMesh a, const SurfaceMesh& b) {
  const int n = int(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

double volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
  return sum;
}

// ---- files ----------------------------------------------------------------------------------------------------

std::string obj(const SurfaceMesh& mesh) {
  std::string text = "# test\r\nmtllib none.mtl\r\n";
  for (const Vec3& p : mesh.points) text += fmt::format("v {} {} {}\r\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) text += fmt::format("f {}/1/1 {}//2 {}\r\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string relative_obj(const SurfaceMesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.points) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  const int n = int(mesh.points.size());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] - n, t[1] - n, t[2] - n);
  return text;
}

std::string ply_header(const SurfaceMesh& mesh, const std::string& format, const std::string& faces) {
  return fmt::format("ply\nformat {} 1.0\ncomment test\nelement vertex {}\nproperty double x\nproperty uchar shade\n"
                     "property float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\n"
                     "end_header\n",
                     format, mesh.points.size(), faces);
}

template <class Number>
void put(std::string& bytes, Number value, bool big_endian) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  if (big_endian) std::reverse(raw, raw + sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

std::string binary_ply(const SurfaceMesh& mesh, const std::string& endian) {
  const bool big = endian == "big";
  std::string bytes = ply_header(mesh, "binary_" + endian + "_endian", std::to_string(mesh.triangles.size()));
  for (const Vec3& p : mesh.points) {
    put(bytes, p[0], big);
    put(bytes, char(9), big);
    put(bytes, float(p[1]), big);
    put(bytes, float(p[2]), big);
  }
  for (const auto& t : mesh.triangles) {
    put(bytes, char(3), big);
    for (const int corner : t) put(bytes, corner, big);
  }
  return bytes;
}

std::string ascii_ply(const SurfaceMesh& mesh) {
  std::string text = ply_header(mesh, "ascii", std::to_string(mesh.triangles.size()));
  for (const Vec3& p : mesh.points) text += fmt::format("{} 9 {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

std::string ascii_stl(const SurfaceMesh& mesh) {
  std::string text = "solid a name of words\n";
  for (const auto& t : mesh.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const int corner : t) {
      const Vec3& p = mesh.points[corner];
      text += fmt::format("  vertex {} {} {}\n", p[0], p[1], p[2]);
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid a name of words\n";
}

std::string binary_stl(const SurfaceMesh& mesh, const std::string& title = "solid but binary") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  put(bytes, std::uint32_t(mesh.triangles.size()), false);
  for (const auto& t : mesh.triangles) {
    bytes.append(12, '\0');
    for (const int corner : t) {
      for (int a = 0; a < 3; ++a) put(bytes, float(mesh.points[corner][a]), false);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

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

ShapeSpec mesh_spec(const std::filesystem::path& file) {
  ShapeSpec spec;
  spec.kind = "mesh";
  spec.file = file;
  spec.where = "scene.toml:3";
  return spec;
}

}  // namespace

TEST_CASE("all formats give the same closed surface") {
  const TemporaryFolder folder;
  const SurfaceMesh ball = sphere(Vec3(0.5, -0.25, 2), 0.75, 2);
  const std::vector<std::pair<std::string, std::string>> files{
      {"ball.obj", obj(ball)}, {"BALL.OBJ", relative_obj(ball)}, {"ball.ply", binary_ply(ball, "little")},
      {"big.ply", binary_ply(ball, "big")}, {"text.ply", ascii_ply(ball)}, {"text.stl", ascii_stl(ball)},
      {"binary.stl", binary_stl(ball)}, {"other.stl", binary_stl(ball, "exported")}};
  for (const auto& [name, bytes] : files) {
    CAPTURE(name);
    std::vector<std::string> notes;
    const SurfaceMesh mesh = read(folder, name, bytes, &notes);
    CHECK(notes.empty());
    CHECK(mesh.points.size() == ball.points.size());  // STL repeats its points; they are welded
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

TEST_CASE("missing, empty, foreign and unfetched files are refused by name") {
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of_file(folder.path / "none.obj"), Catch::Contains("none.obj") && Catch::Contains("No such file"));
  CHECK_THAT(refusal(folder, "empty.ply", ""), Catch::Contains("0 bytes"));
  CHECK_THAT(refusal(folder, "blank.obj", "\n\n"), Catch::Contains("no faces"));
  std::filesystem::create_directory(folder.path / "dir.obj");
  CHECK_THAT(refusal_of_file(folder.path / "dir.obj"), Catch::Contains("folder"));
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
  const std::vector<std::pair<std::string, std::string>> files{
      {"cut.obj", obj(ball)}, {"cut.ply", binary_ply(ball, "little")}, {"cut_text.ply", ascii_ply(ball)},
      {"cut_text.stl", ascii_stl(ball)}, {"cut.stl", binary_stl(ball, "exported")}};
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
  std::string list = "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
                     "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  put(list, huge, false);
  CHECK_THAT(refusal(folder, "list.ply", list), Catch::Contains("list"));
}

TEST_CASE("indices and coordinates out of range are refused with their line or byte") {
  const TemporaryFolder folder;
  const std::string points = obj({cube().points, {}, {}});  // 10 lines
  CHECK_THAT(refusal(folder, "a.obj", points + "f 1 2 9\n"), Catch::Contains("a.obj:11: ") && Catch::Contains("point 9"));
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
  // The projective plane with six points, each edge in two triangles.
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
  mesh.triangles.push_back({3, 2, 1});   // as the second, the other way round
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
  mesh.points.push_back(Vec3(0.5, 0, 0));  // the edge 0-1 is whole in one face and split in the other
  mesh.triangles[4] = {0, 8, 4};
  mesh.triangles.push_back({8, 1, 4});
  mesh.triangles.push_back({0, 1, 8});
  std::vector<std::string> notes;
  const SurfaceMesh read_mesh = read(folder, "split.obj", obj(mesh), &notes);
  CHECK(read_mesh.triangles.size() == 13);
  CHECK(volume(read_mesh) == Approx(1));
  CHECK_THAT(notes.at(0), Catch::Contains("1 triangles without area"));
}

TEST_CASE("the distance to a triangle is that to its face, edges or corners") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const double round_off = 1e-15;  // of lengths about 1
  CHECK(mesh::distance_to_triangle(Vec3(0.2, 0.3, -0.5), a, b, c) == Approx(0.5).margin(round_off));
  CHECK(mesh::distance_to_triangle(Vec3(0.5, -0.3, 0.4), a, b, c) == Approx(0.5).margin(round_off));
  CHECK(mesh::distance_to_triangle(Vec3(1, 1, 0), a, b, c) == Approx(std::sqrt(0.5)).margin(round_off));
  CHECK(mesh::distance_to_triangle(Vec3(3, -1, 2), a, b, c) == Approx(3).margin(4 * round_off));
  CHECK(mesh::distance_to_triangle(Vec3(0.5, 0.5, 0), a, b, b) == Approx(0.5).margin(round_off));  // no area
}

TEST_CASE("the nearest of many triangles is the nearest of all one by one") {
  const SurfaceMesh ball = sphere(Vec3(0.1, 0.2, 0.3), 0.4, 3);
  const mesh::NearestTriangle nearest(ball);
  for (int i = 0; i < 100; ++i) {
    const Vec3 x(std::sin(1.3 * i), std::sin(2.1 * i), std::sin(0.7 * i));
    double least = 10;
    for (const auto& t : ball.triangles) {
      least = std::min(least, mesh::distance_to_triangle(x, ball.points[t[0]], ball.points[t[1]], ball.points[t[2]]));
    }
    CHECK(nearest.distance(x, 10) == least);
    CHECK(nearest.distance(x, least / 2) == least / 2);
  }
}

TEST_CASE("the distance to a sphere of triangles converges to the sphere's with the square of their size") {
  const TemporaryFolder folder;
  const Vec3 center(0.513, 0.487, 0.519);
  const double radius = 0.3;
  double previous = 0;
  for (const int refinement : {3, 4, 5}) {
    const auto file = folder.write("ball.ply", binary_ply(sphere(center, radius, refinement), "little"));
    const double h = 0.8 * std::pow(0.5, refinement);  // cells about as large as triangles
    const auto phi = make_shape<3>(mesh_spec(file), {h, nullptr});
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {  // spiral of directions, distances within four cells of the surface
      const double z = 1 - (2 * i + 1) / 4000.0, angle = 2.399963 * i, s = std::sqrt(1 - z * z);
      const double d = 2 * h * std::sin(0.37 * i);
      const Vec3 x = center + (radius + d) * Vec3(s * std::cos(angle), s * std::sin(angle), z);
      worst = std::max(worst, std::abs((*phi)(x) - d));
    }
    CAPTURE(refinement, worst);
    // Sagitta of edges of 1.7 h / 1.6 and trilinear interpolation 3 h^2 / 8 r', r' >= radius - 2 h.
    CHECK(worst < h * h / radius);
    if (previous > 0) CHECK(worst < previous / 3);  // order 2 gives 4
    previous = worst;
  }
}

TEST_CASE("the distance to a cube of triangles is exact on the voxels within its band") {
  const TemporaryFolder folder;
  ShapeSpec spec = mesh_spec(folder.write("cube.stl", binary_stl(cube(), "exported")));
  const double h = 0.0625;
  const auto phi = make_shape<3>(spec, {h, nullptr});
  ShapeSpec exact_spec;
  exact_spec.kind = "box";
  exact_spec.upper = Vec3(1, 1, 1);
  const auto exact = make_shape<3>(exact_spec, {h, nullptr});
  for (int k = -3; k < 20; ++k) {
    for (int j = -3; j < 20; ++j) {
      for (int i = -3; i < 20; ++i) {
        const Vec3 x = h * Vec3(i, j, k);
        const double d = std::clamp((*exact)(x), -5 * h, 5 * h);
        if ((*phi)(x) != Approx(d).margin(1e-6)) FAIL(x.transpose() << ": " << (*phi)(x) << " for " << d);  // float
      }
    }
  }
}

TEST_CASE("a mesh shape follows its transform and inversion") {
  const TemporaryFolder folder;
  ShapeSpec spec = mesh_spec(folder.write("ball.obj", obj(sphere(Vec3(1, 0, 0), 0.5, 5))));
  spec.transform.scale = 0.5;
  spec.transform.rotate = {Vec3(0, 0, 1), 90};
  spec.transform.translate = Vec3(0.1, 0.2, 0.3);
  const Vec3 center(0.1, 0.7, 0.3);
  const ShapeOptions options{0.02, nullptr};
  // A chord of triangles of 1/32 of the circle lies 0.25 (2 pi / 128)^2 / 8 = 8e-5 inside; h^2 interpolation 4e-4.
  CHECK((*make_shape<3>(spec, options))(Vec3(center + Vec3(0.28, 0, 0))) == Approx(0.03).margin(1e-3));
  const SurfaceMesh surface = shape_surface<3>(spec, options, Vec3(0, 0, 0), Vec3(1, 1, 1));
  CHECK(volume(surface) == Approx(4 * pi / 3 * std::pow(0.25, 3)).epsilon(0.01));
  spec.invert = true;
  CHECK((*make_shape<3>(spec, options))(Vec3(center + Vec3(0.28, 0, 0))) == Approx(-0.03).margin(1e-3));
  CHECK(volume(shape_surface<3>(spec, options, Vec3(0, 0, 0), Vec3(1, 1, 1))) == Approx(-volume(surface)));
}

TEST_CASE("a shell keeps its cavity, and a solid in the cavity is solid") {
  const TemporaryFolder folder;
  const Vec3 c(0.5, 0.5, 0.5);
  const SurfaceMesh nested = joined(joined(sphere(c, 0.45, 4), sphere(c, 0.3, 4)), sphere(c, 0.12, 4));
  std::vector<std::string> notes;
  const SurfaceMesh mesh = read(folder, "shell.ply", binary_ply(nested, "little"), &notes);
  const double expected = 4 * pi / 3 * (std::pow(0.45, 3) - std::pow(0.3, 3) + std::pow(0.12, 3));
  CHECK(volume(mesh) == Approx(expected).epsilon(0.01));  // chords of 64 segments a circle
  CHECK(notes.size() == 1);
  const auto phi = make_shape<3>(mesh_spec(folder.path / "shell.ply"), {0.02, nullptr});
  for (const auto& [r, d] : {std::pair{0.47, 0.02}, {0.43, -0.02}, {0.32, -0.02}, {0.28, 0.02}, {0.14, 0.02}, {0.1, -0.02}}) {
    CHECK((*phi)(Vec3(c + r * Vec3(0.48, 0.6, 0.64))) == Approx(d).margin(2e-3));  // h^2 / r
  }
}

TEST_CASE("a mesh too large for its cells is refused before it is sampled") {
  const TemporaryFolder folder;
  const auto file = folder.write("cube.obj", obj(cube(Vec3(0, 0, 0), 1e4)));
  CHECK_THROWS_WITH(make_shape<3>(mesh_spec(file), {0.01, nullptr}),
                    Catch::StartsWith("scene.toml:3: ") && Catch::Contains("scale"));
}

TEST_CASE("an error in a mesh names the scene's line and the mesh's line") {
  const TemporaryFolder folder;
  const auto file = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  CHECK_THROWS_WITH(make_shape<3>(mesh_spec(file), {0.1, nullptr}),
                    Catch::StartsWith("scene.toml:3: ") && Catch::Contains("bad.obj:2: "));
}
