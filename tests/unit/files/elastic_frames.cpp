// Frames of elastic solids: files for ParaView and Blender, read back by an independent program.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>

#include "base/scene.h"
#include "files/checked_file.h"
#include "files/frames.h"
#include "files/point_cache.h"
#include "files/vtu_reader.h"
#include "info/info.h"
#include "solid/elastic/output.h"
#include "unit/files/scratch.h"
#include "unit/run/fake_simulation.h"

namespace elastic_frames_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

// One body with displacements that are a smooth function of the frame.
template <int Dim>
class Deforming : public FakeSimulation {
 public:
  int frame = 0;
  bool broken = false;

  explicit Deforming(int order)
      : body_(make_elastic_body<Dim>(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(2), order),
                                     elastic_material<Dim>("corotated"), {1000, lame_of(1e5, 0.3), 0, 0})),
        surface_(surface_of(body_.mesh)) {}
  SurfaceMesh solid_surface(std::size_t) const override {
    ElasticSurface moved = surface_;
    move_surface(moved, body_.mesh, displacement());
    return moved.facets;
  }
  VolumeFrame solid_volume(std::size_t index) const override {
    if (index == 0) return {};
    Eigen::VectorXd u = displacement();
    if (broken) u[3] = std::numeric_limits<double>::quiet_NaN();
    return volume_frame(body_, surface_, u, u);
  }

 private:
  Eigen::VectorXd displacement() const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(body_.size());
    for (std::size_t n = 0; n < body_.mesh.nodes.size(); ++n) {
      const Vec<Dim>& X = body_.mesh.nodes[n];
      u[Dim * Eigen::Index(n)] = 0.1 * frame * X[1] * X[1];
      u[Dim * Eigen::Index(n) + 1] = 0.02 * frame * X[0];
    }
    return u;
  }
  ElasticBody<Dim> body_;
  ElasticSurface surface_;
};

Scene scene_of(int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.domain.cell_size = 0.5;
  scene.domain.cells = {2, 2, 1};
  scene.time.frame_rate = 10;
  scene.output.frames = {};
  scene.solids.resize(2);
  scene.solids[0].name = "wall";
  scene.solids[1].name = "../the gate";
  scene.solids[1].kind = SolidKind::elastic;
  return scene;
}

template <int Dim>
void write_frames(const Scene& scene, const RunPaths& paths, Deforming<Dim>& simulation, int first, int last) {
  const Communicator ranks;
  FrameWriter writer(scene, paths, ranks);
  for (int n = first; n <= last; ++n) {
    simulation.frame = n;
    writer.write({n, n / 10., 0.01}, simulation, PhaseFault::none);
  }
}

void check_by_reader(const RunPaths& paths) {
  const auto reader = std::filesystem::path(__FILE__).parent_path() / "read_elastic_frames.py";
  const std::string command = "/usr/bin/python3 '" + reader.string() + "' '" + paths.frames().string() + "'";
  CHECK(std::system(command.c_str()) == 0);
}

std::int32_t samples_of(const std::filesystem::path& file) {
  std::int32_t samples = 0;
  std::memcpy(&samples, contents(file).data() + 28, sizeof samples);
  return samples;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("frames of elastic solids are read by others", "[elastic]", ((int Dim), Dim), 2, 3) {
  for (const int order : {1, 2}) {
    const ScratchFolder folder;
    const RunPaths paths{folder.path()};
    make_folder(paths.frames());
    Deforming<Dim> simulation(order);
    const Scene scene = scene_of(Dim);
    write_frames(scene, paths, simulation, 0, 3);
    check_by_reader(paths);
    CHECK(entries(folder.path()) == 1);  // nothing beside frames/ for any name of the solid
    CHECK(samples_of(paths.frames() / "_._the_gate.pc2") == 4);
    // The renderer's reader accepts the surfaces in solids.NNNN.vtu for any shape.
    const auto solids = render::read_solids(paths.frames() / "solids.0003.vtu");
    CHECK(solids.mesh.points.size() == 2 * simulation.solid_surface(1).points.size());
  }
}

// A run killed after frame 3 resumes from a checkpoint at frame 1; then from one at frame 4 without its cache.
TEST_CASE("a point cache survives a resume", "[elastic]") {
  const ScratchFolder folder;
  const RunPaths paths{folder.path()};
  make_folder(paths.frames());
  const auto cache = paths.frames() / "_._the_gate.pc2";
  Deforming<3> simulation(2);
  const Scene scene = scene_of(3);
  write_frames(scene, paths, simulation, 0, 3);
  put(cache, contents(cache) + "half a sample");
  write_frames(scene, paths, simulation, 2, 2);
  CHECK(samples_of(cache) == 3);
  write_frames(scene, paths, simulation, 3, 4);
  check_by_reader(paths);
  const std::string whole = contents(cache);
  // Same bytes as those of an uninterrupted run.
  const ScratchFolder other;
  make_folder(RunPaths{other.path()}.frames());
  write_frames(scene, RunPaths{other.path()}, simulation, 0, 4);
  CHECK(contents(RunPaths{other.path()}.frames() / "_._the_gate.pc2") == whole);
  for (const std::string& damaged : {std::string(), std::string("no cache"), whole.substr(0, whole.size() / 2)}) {
    put(cache, damaged);
    write_frames(scene, paths, simulation, 5, 6);
    float start = 0;
    std::memcpy(&start, contents(cache).data() + 20, sizeof start);
    CHECK(start == 5);
    CHECK(samples_of(cache) == 2);
  }
}

TEST_CASE("a frame of an elastic solid that is not a number is not written", "[elastic]") {
  const ScratchFolder folder;
  const RunPaths paths{folder.path()};
  make_folder(paths.frames());
  Deforming<2> simulation(1);
  simulation.broken = true;
  const Scene scene = scene_of(2);
  CHECK_THROWS_WITH(write_frames(scene, paths, simulation, 0, 0),
                    Contains("displacement at node 1 of solid '../the gate' is not a number"));
  CHECK(entries(paths.frames()) == 0);
}

TEST_CASE("files are named after solids, each differently", "[elastic]") {
  using Names = std::vector<std::string>;
  CHECK(point_cache::stems({"gate", "a b", "a/b", "..", "é"}) == Names{"gate", "a_b", "a_b_", "_.", "__"});
}

TEST_CASE("info tells what is in the frames of elastic solids", "[elastic]") {
  const ScratchFolder folder;
  const RunPaths paths{folder.path()};
  make_folder(paths.frames());
  Deforming<3> simulation(2);
  write_frames(scene_of(3), paths, simulation, 0, 3);
  const auto text = [](const std::filesystem::path& path) {
    std::string all;
    for (const std::string& line : describe_path(path)) all += line + "\n";
    return all;
  };
  const std::string elastic = text(paths.frames() / "elastic.0003.vtu");
  CHECK_THAT(elastic, Contains("solids at t = 0.3 s"));
  // At y = 1, x = 1: 0.3 along x, 0.06 along y.
  CHECK_THAT(elastic, Contains("../the gate: 125 points, 48 elements; at most 0.3059 m displaced, 0.3059 m/s"));
  CHECK_THAT(text(paths.frames() / "solids.0003.vtu"), Contains("../the gate: 98 points, 192 facets\n"));
  CHECK_THAT(text(folder.path()), Contains("deforming surface _._the_gate.pc2: 98 points in 4 frames from frame 0"));
  put(paths.frames() / "elastic.0004.vtu", "<VTKFile type=\"UnstructuredGrid\">");
  CHECK_THROWS_WITH(text(paths.frames() / "elastic.0004.vtu"),
                    Contains("elastic.0004.vtu:1: is not XML, or is cut short"));
  const std::string whole = contents(paths.frames() / "elastic.0003.vtu");
  for (std::size_t cut = 100; cut < whole.size(); cut += 997) {
    put(paths.frames() / "elastic.0005.vtu", whole.substr(0, cut));
    try {
      text(paths.frames() / "elastic.0005.vtu");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::bad_input);
    }
  }
}

}  // namespace elastic_frames_tests
