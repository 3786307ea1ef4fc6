// Sequences of meshes: names of their files, places in time, what is refused.
#include "geometry/shapes/mesh_sequence.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/numbered_files.h"
#include "base/solid_spec.h"

namespace mesh_sequence_tests {
using namespace seiche;
namespace fs = std::filesystem;

namespace {

class Files {
 public:
  Files() : folder_(fs::temp_directory_path() / fmt::format("seiche_sequence_{}", std::random_device()())) {
    fs::create_directory(folder_);
  }
  ~Files() { fs::remove_all(folder_); }
  // A tetrahedron of edge `size` at x = `at`.
  void write(int n, double at, double size = 1,
             const std::string& faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n") const {
    std::ofstream(folder_ / fmt::format("tet.{}.obj", n))
        << fmt::format("v {0:.17g} 0 0\nv {1:.17g} 0 0\nv {0:.17g} {2:.17g} 0\nv {0:.17g} 0 {2:.17g}\n", at, at + size,
                       size)
        << faces;
  }
  // A square of edge 1 about the origin, turned. 2D.
  void write_square(int n, double degrees, double size = 1) const {
    std::ofstream file(folder_ / fmt::format("square.{}.csv", n));
    for (int corner = 0; corner < 4; ++corner) {
      const double angle = (degrees + 45 + 90 * corner) * M_PI / 180, r = size * std::sqrt(0.5);
      file << fmt::format("{:.17g}, {:.17g}\n", r * std::cos(angle), r * std::sin(angle));
    }
  }
  void write_text(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  MeshSequence read(SequenceSpec spec, int dimension = 3) const {
    ShapeSpec shape;
    shape.kind = "mesh";
    shape.file = folder_ / (dimension == 2 ? "square.0.csv" : "tet.0.obj");
    shape.where = "scene.toml:7";
    return {dimension, shape, spec, {0.1, nullptr}};
  }
  std::string fault(SequenceSpec spec, int dimension = 3) const {
    try {
      read(spec, dimension);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

double x_at(const MeshSequence& sequence, double t) {
  return sequence.points_at(t)[0][0];
}

}  // namespace

TEST_CASE("files of a sequence count up in the last number of their name") {
  CHECK(numbered_files("a/flag.0098.ply", 3) ==
        std::vector<fs::path>{"a/flag.0098.ply", "a/flag.0099.ply", "a/flag.0100.ply"});
  CHECK(numbered_files("take2_9.obj", 2) == std::vector<fs::path>{"take2_9.obj", "take2_10.obj"});
  CHECK(numbered_files("7up.obj", 2) == std::vector<fs::path>{"7up.obj", "8up.obj"});
  CHECK(numbered_files("flag.ply", 3).empty());
}

TEST_CASE("points of a sequence move from mesh to mesh without jumps of velocity and acceleration") {
  const Files files;
  for (int n = 0; n < 6; ++n) files.write(n, 0.1 * n * n);
  const MeshSequence once = files.read({6, 2, 1, false});
  for (int n = 0; n < 6; ++n) CHECK(x_at(once, 1 + 0.5 * n) == Approx(0.1 * n * n).margin(1e-14));
  CHECK(x_at(once, -3) == 0);
  CHECK(x_at(once, 1e12) == Approx(2.5));
  const double d = 1e-4;
  const auto slope = [&](double t) { return (x_at(once, t + d) - x_at(once, t)) / d; };
  const auto bend = [&](double t) { return (slope(t + d) - slope(t)) / d; };
  for (const double t : {1.5, 2.0, 2.5, 3.0}) {
    CHECK(slope(t) == Approx(slope(t - d)).margin(1e-3));
    CHECK(bend(t) == Approx(bend(t - 2 * d)).margin(0.02));
  }
  CHECK(std::abs(slope(1)) < 1e-3);  // at rest where it begins and ends
  CHECK(std::abs(slope(3.5 - d)) < 1e-3);
}

TEST_CASE("a sequence that loops goes round, also before its start") {
  const Files files;
  for (int n = 0; n < 8; ++n) files.write(n, std::cos(2 * M_PI * n / 8));
  const MeshSequence round = files.read({8, 8, 0, true});
  for (const double t : {0.0, 0.37, 0.93}) {
    CHECK(x_at(round, t) == Approx(x_at(round, t + 5)).margin(1e-12));
    CHECK(x_at(round, t) == Approx(x_at(round, t - 2)).margin(1e-12));
    CHECK(x_at(round, t) == Approx(std::cos(2 * M_PI * t)).margin(2e-3));
  }
}

TEST_CASE("meshes that do not follow the first are refused") {
  using Catch::Matchers::Contains;
  const Files files;
  files.write(0, 0);
  files.write(1, 0.1, 1, "f 1 3 2\nf 1 2 4\nf 2 3 4\n");
  CHECK_THAT(files.fault({2, 1, 0, false}), Contains("scene.toml:7") && Contains("tet.1.obj"));
  files.write(1, 0.1);
  CHECK_THAT(files.fault({3, 1, 0, false}), Contains("scene.toml:7") && Contains("tet.2.obj"));
  files.write(2, 0.1, -1);
  CHECK_THAT(files.fault({3, 1, 0, false}), Contains("tet.2.obj") && Contains("turned inside out"));
}

TEST_CASE("outlines follow each other as meshes do, in 2D") {
  using Catch::Matchers::Contains;
  const Files files;
  for (int n = 0; n < 8; ++n) files.write_square(n, 45 * n);
  const MeshSequence turning = files.read({8, 8, 0, true}, 2);
  CHECK(turning.first().segments.size() == 4);
  for (const double t : {0.0, 0.3, 0.71})
    CHECK(x_at(turning, t) == Approx(std::sqrt(0.5) * std::cos(2 * M_PI * t + M_PI / 4)).margin(2e-3));
  files.write_text("square.1.csv", "0 0\n1 0\n0 1\n");
  CHECK_THAT(files.fault({8, 8, 0, true}, 2), Contains("square.1.csv has 3 points, the first 4"));
  files.write_text("square.1.csv", "0 0\n0 1\n1 1\n1 0\n");
  CHECK_THAT(files.fault({8, 8, 0, true}, 2), Contains("square.1.csv is turned inside out"));
}

TEST_CASE("points that cross between two meshes are refused with the files and the time") {
  using Catch::Matchers::Contains;
  const Files files;
  files.write_square(0, 0);
  files.write_square(1, 180);
  CHECK_THAT(files.fault({2, 4, 1, false}, 2), Contains("scene.toml:7") && Contains("square.0.csv and square.1.csv") &&
                                                   Contains("at t = 1.125 s") && Contains("collapses"));
  files.write_square(1, 90);
  files.write_square(2, 180);
  files.write_square(3, 360);
  CHECK_THAT(files.fault({4, 1, 0, false}, 2), Contains("square.2.csv and square.3.csv"));
  files.write_square(3, 270);
  CHECK(files.fault({4, 1, 0, true}, 2).empty());
  for (const double at : {0, 3})  // a square that passes through another
    files.write_text(at == 0 ? "square.0.csv" : "square.1.csv",
                     fmt::format("{0} 0\n{1} 0\n{1} 1\n{0} 1\n\n1.6 0.2\n2.4 0.2\n2.4 0.8\n1.6 0.8\n", at, at + 1));
  CHECK_THAT(files.fault({2, 1, 0, false}, 2), Contains("t = 0.375 s, the surface crosses itself"));
  for (const double at : {0, 3})  // a tetrahedron through another
    files.write_text(at == 0 ? "tet.0.obj" : "tet.1.obj",
                     fmt::format("v {0} 0 0\nv {1} 0 0\nv {0} 1 0\nv {0} 0 1\nv 1.6 0.1 0.1\nv 2.4 0.1 0.1\n"
                                 "v 1.6 0.5 0.1\nv 1.6 0.1 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 5 7 6\n"
                                 "f 5 6 8\nf 6 7 8\nf 7 5 8\n",
                                 at, at + 1));
  CHECK_THAT(files.fault({2, 1, 0, false}), Contains("tet.0.obj and tet.1.obj") && Contains("crosses itself"));
}

}  // namespace mesh_sequence_tests
