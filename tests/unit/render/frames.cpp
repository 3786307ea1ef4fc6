// Pictures and descriptions of frames on disk.
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "files/checked_file.h"
#include "files/vtk.h"
#include "files/vtu_reader.h"
#include "info/info.h"
#include "render/extras.h"
#include "render/frame.h"
#include "render/png_writer.h"
#include "render/run.h"
#include "unit/render/common.h"

namespace frames_tests {
using namespace seiche;
using namespace seiche::render;
using namespace seiche::testing;
namespace fs = std::filesystem;

namespace {

// Water below the height 0.5 + slope (x - 0.5) in the unit cube or square, flowing at (3, 4, 0) m/s.
vdb::Frame sloping_water(int dimension, int n, int number, double slope) {
  vdb::Frame frame;
  frame.dimension = dimension;
  frame.cell_size = 1.0 / n;
  frame.time = 0.1 * number;
  frame.number = number;
  frame.creator = "test";
  const int depth = dimension == 3 ? n : 1;
  const vdb::Grid surface{"surface", vdb::GridKind::level_set, 3.0f / float(n), {}};
  vdb::Block values{{0, 0, 0}, {n, n, depth}, {}}, vectors{{0, 0, 0}, {n, n, depth}, {}};
  for (int c = 0; c < n * n * depth; ++c) {
    const double x = (c % n + 0.5) / n, y = (c / n % n + 0.5) / n;
    const double distance = (y - 0.5 - slope * (x - 0.5)) / std::hypot(1, slope);
    values.values.push_back(float(std::clamp(distance, -3.0 / n, 3.0 / n)));
    vectors.values.insert(vectors.values.end(), {3, 4, 0});
  }
  set_grids(surface, values, vectors, frame);
  return frame;
}

ExitCode code_of(const std::function<void()>& action) {
  try {
    action();
    return ExitCode::done;
  } catch (const Error& error) {
    return error.code();
  }
}

}  // namespace

TEST_CASE("surfaces of solids come back from a .vtu as they were written") {
  const ScratchRun scratch;
  const fs::path file = scratch.folder / "solids.0000.vtu";
  SurfaceMesh tetrahedron{
      {{0, 0, 0}, {1.0 / 3, 0, 0}, {0, 1e-7, 0}, {0, 0, -2e5}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
  SurfaceMesh outline{{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}}, {}, {{0, 1}, {1, 2}, {2, 0}}};
  write_file(file, vtk::surfaces({tetrahedron, {}, outline}, {"one", "empty", "two"}, 0.25));
  const SolidMesh back = read_solids(file);
  REQUIRE(back.mesh.points.size() == 7);
  for (std::size_t i = 0; i < 4; ++i) CHECK(back.mesh.points[i] == tetrahedron.points[i]);
  CHECK(back.mesh.triangles == tetrahedron.triangles);
  CHECK(back.mesh.segments == std::vector<std::array<int, 2>>{{4, 5}, {5, 6}, {6, 4}});
  CHECK(back.solid == std::vector<int>{0, 0, 0, 0, 2, 2, 2});
}

TEST_CASE("ascii and appended .vtu arrays are read too, and damaged files refused") {
  const ScratchRun scratch;
  const fs::path file = scratch.folder / "solids.0000.vtu";
  const std::string head = "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece>";
  const std::string cells =
      "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
      "<DataArray type='Int32' Name='offsets' format='ascii'>3</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells>";
  const std::string points =
      "<Points><DataArray type=\"Float32\" format=\"ascii\">0 0 0 1 0 0 0 1.5 0</DataArray></Points>";
  write_file(file, head + points + cells + "</Piece></UnstructuredGrid></VTKFile>");
  CHECK(read_solids(file).mesh.points.at(2) == Vec3(0, 1.5, 0));
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 2.5, 0};
  const std::uint32_t size = sizeof corners;
  std::string raw(4 + size, ' ');
  std::memcpy(raw.data(), &size, 4);
  std::memcpy(raw.data() + 4, corners, size);
  const std::string far = "<Points><DataArray type=\"Float32\" format=\"appended\" offset=\"0\"/></Points>";
  const std::string tail = "</Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_";
  write_file(file, head + far + cells + tail + raw + "</AppendedData></VTKFile>");
  CHECK(read_solids(file).mesh.points.at(2) == Vec3(0, 2.5, 0));
  const std::string bad_index = "<DataArray type='Int32' Name='connectivity' format='ascii'>0 1 3</DataArray>";
  for (const std::string& text : {std::string("no xml"), head, head + far + cells + tail + raw.substr(0, 20),
                                  head + points + "<Cells>" + bad_index + cells.substr(7) + "</Piece>"}) {
    write_file(file, text);
    const bool refused = code_of([&] { read_solids(file); }) == ExitCode::bad_input;
    CHECK((refused || read_solids(file).mesh.triangles.empty()));
  }
}

TEST_CASE("a run is rendered in 2D and 3D, with label, contact sheet and only the frames asked for") {
  for (const int dimension : {2, 3}) {
    const ScratchRun scratch;
    for (int number = 0; number < 4; ++number) store(scratch, sloping_water(dimension, 16, number, 0.1 * number));
    RenderOptions options;
    options.run = scratch.folder;
    options.width = 320;
    options.height = 240;
    options.frames = "1-3";
    options.contact_sheet = fs::path();
    CHECK(render_run(options, silent).pictures == 3);
    const fs::path out = scratch.folder / "pictures";
    CHECK(!fs::exists(out / "frame.0000.png"));
    const Image first = read_png(out / "frame.0001.png"), last = read_png(out / "frame.0003.png");
    CHECK(first.width == 320);
    CHECK(first.height == 240);
    int label = 0, differ = 0;
    for (std::size_t i = 0; i < first.rgb.size(); ++i) {
      const std::size_t x = i / 3 % 320, y = i / 960;
      label += x < 160 && y < 18 && first.rgb[i] < 120;
      differ += first.rgb[i] != last.rgb[i];
    }
    CHECK(label > 100);    // "frame 1   t = 0.100 s": 17 glyphs of 9 pixels' height, three channels a dark pixel
    CHECK(differ > 1000);  // the surface moved
    CHECK(read_png(out / "contact_sheet.png").width > 3 * 320);
  }
}

TEST_CASE("labels of a contact sheet cover nothing of its pictures") {
  ContactSheet sheet(2, 200, 100, "");
  Image red{200, 100, std::vector<std::uint8_t>(std::size_t(3 * 200 * 100))};
  for (std::size_t i = 0; i < red.rgb.size(); i += 3) red.rgb[i] = 255;
  for (const int n : {0, 1}) sheet.offer(n, red, "frame 12   t = 0.500 s");
  int reds = 0, dark = 0;
  for (std::size_t i = 0; i < sheet.image().rgb.size(); i += 3) {
    const std::uint8_t* pixel = &sheet.image().rgb[i];
    reds += pixel[0] > 250 && pixel[1] < 5 && pixel[2] < 5;
    dark += pixel[0] < 120;
  }
  CHECK(reds == 2 * 200 * 100);
  CHECK(dark > 100);
}

TEST_CASE("a folder without frames, a frame that is not there and a field that is not there are bad input") {
  const ScratchRun scratch;
  RenderOptions options;
  options.run = scratch.folder;
  CHECK(code_of([&] { render_run(options, silent); }) == ExitCode::bad_input);
  store(scratch, sloping_water(2, 8, 0, 0));
  options.frames = "1";
  CHECK(code_of([&] { render_run(options, silent); }) == ExitCode::bad_input);
  options.frames = "all";
  options.color = "pressure";
  CHECK(code_of([&] { render_run(options, silent); }) == ExitCode::bad_input);
  CHECK(!fs::exists(scratch.folder / "pictures"));
}

TEST_CASE("speed is the length of the velocity at cell centres") {
  const ScalarVolume speed = quantity_of(sloping_water(3, 6, 0, 0), "speed");
  for (const float value : speed.values) CHECK(value == Approx(5));
}

TEST_CASE("info tells a frame's fields, time and liquid volume") {
  const ScratchRun scratch;
  store(scratch, sloping_water(3, 20, 2, 0));
  std::string text;
  for (const std::string& line : describe_path(scratch.folder / "frames" / "frame.0002.vdb")) text += line + "\n";
  CHECK_THAT(text, Catch::Contains("frame 2 at t = 0.2 s, 3D"));
  CHECK_THAT(text, Catch::Contains("surface (level set, m): 20 x 20 x 20 cells of 0.05 m"));
  CHECK_THAT(text, Catch::Contains("about 0.5 m^3 below the surface"));
  CHECK_THAT(text, Catch::Contains("vel (staggered vectors)") && Catch::Contains("5 to 5"));
  text.clear();
  // Liquid within solids does not count; the run's table has the right volume.
  write_file(scratch.folder / "stats.csv",
             "step,time,dt,liquid_volume\n1,0.1,0.1,0.4\n2,0.2,0.1,0.375\n3,0.3,0.1,0.3\n");
  for (const std::string& line : describe_path(scratch.folder / "frames" / "frame.0002.vdb")) text += line + "\n";
  CHECK_THAT(text, Catch::Contains("liquid volume 0.375 m^3 (stats.csv)"));
  fs::remove(scratch.folder / "stats.csv");
  text.clear();
  for (const std::string& line : describe_path(scratch.folder)) text += line + "\n";
  CHECK_THAT(text, Catch::Contains("1 frame, 2 to 2") && Catch::Contains("no checkpoints"));
  CHECK(code_of([&] { describe_path(scratch.folder / "nothing"); }) == ExitCode::bad_input);
}

}  // namespace frames_tests
