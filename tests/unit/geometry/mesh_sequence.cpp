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
  MeshSequence read(SequenceSpec spec) const {
    ShapeSpec shape;
    shape.kind = "mesh";
    shape.file = folder_ / "tet.0.obj";
    shape.where = "scene.toml:7";
    return {shape, spec, {0.1, nullptr}};
  }
  std::string fault(SequenceSpec spec) const {
    try {
      read(spec);
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

}  // namespace mesh_sequence_tests
