// Ways of the camera, pictures without ground, EXR.
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "files/checked_file.h"
#include "render/exr_writer.h"
#include "render/pictures.h"
#include "render/png_writer.h"
#include "render/trace.h"
#include "unit/render/common.h"

namespace cameras_tests {
using namespace seiche;
using namespace seiche::render;
using namespace seiche::testing;
namespace fs = std::filesystem;

namespace {

// A ball of liquid in the unit cube, moving along x.
vdb::Frame ball(int n, int number) {
  vdb::Frame frame;
  frame.cell_size = 1.0 / n;
  frame.number = number;
  frame.time = number;
  frame.creator = "test";
  const vdb::Grid surface{"surface", vdb::GridKind::level_set, 3.0f / float(n), {}};
  vdb::Block values{{0, 0, 0}, {n, n, n}, {}}, vectors{{0, 0, 0}, {n, n, n}, {}};
  for (int c = 0; c < n * n * n; ++c) {
    const Vec3 x((c % n + 0.5) / n, (c / n % n + 0.5) / n, (c / (n * n) + 0.5) / n);
    values.values.push_back(float(std::clamp((x - Vec3(0.7, 0.5, 0.5)).norm() - 0.25, -3.0 / n, 3.0 / n)));
    vectors.values.insert(vectors.values.end(), {1, 0, 0});
  }
  set_grids(surface, values, vectors, frame);
  return frame;
}

RenderOptions small(const ScratchRun& scratch) {
  RenderOptions options;
  options.run = scratch.folder;
  options.width = 200;
  options.height = 150;
  return options;
}

Image draw_one(const ScratchRun& scratch, const RenderOptions& options, const std::string& name = "frame.0000.png") {
  render_run(options, silent);
  return read_png(scratch.folder / "pictures" / name);
}

// Mean colour of the pixels around the middle of the picture.
Vec3f middle_of(const Image& image) {
  Vec3f sum = Vec3f::Zero();
  for (int y = image.height / 2 - 8; y < image.height / 2 + 8; ++y)
    for (int x = image.width / 2 - 8; x < image.width / 2 + 8; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += float(image.rgb[3 * std::size_t(y * image.width + x) + std::size_t(c)]);
  return sum / 256;
}

}  // namespace

TEST_CASE("the camera's path goes through its rows, straight or smoothly, and rests beyond them") {
  const ScratchRun scratch;
  const fs::path file = scratch.folder / "path.csv";
  write_file(file,
             "time,eye_x,eye_y,eye_z,look_x,look_y,look_z,degrees\n0,0,0,5,0,0,0,30\n2,4,0,5,0,0,0,40\r\n"
             "\n3,4,8,5,1,0,0,40\n");
  const CameraPath straight = read_camera_path(file, CurveForm::linear);
  CHECK(straight.at(1).eye == Vec3f(2, 0, 5));
  CHECK(straight.at(2.5).eye == Vec3f(4, 4, 5));
  CHECK(straight.at(2.5).look == Vec3f(0.5f, 0, 0));
  CHECK(straight.at(1).degrees == 35);  // half of the way from 30 to 40
  CHECK(straight.at(-1).eye == Vec3f(0, 0, 5));
  CHECK(straight.at(9).eye == Vec3f(4, 8, 5));
  const CameraPath smooth = read_camera_path(file, CurveForm::smooth);
  CHECK(smooth.at(2).eye == Vec3f(4, 0, 5));
  float before = 0;
  for (double t = 0; t <= 2; t += 0.01) {
    CHECK(smooth.at(t).eye.x() >= before);  // no overshoot
    before = smooth.at(t).eye.x();
  }
  CHECK(before <= 4);
  write_file(file, "0;0;0;5;0;0;0\n1;1;0;5;0;0;0\n");
  CHECK(read_camera_path(file, CurveForm::smooth).at(0).degrees == CameraSpec().degrees);
}

TEST_CASE("a path that cannot be used is refused with its line") {
  const ScratchRun scratch;
  const fs::path file = scratch.folder / "path.csv";
  const auto refused = [&](const std::string& text) {
    write_file(file, text);
    return message_of([&] { read_camera_path(file, CurveForm::smooth); });
  };
  CHECK_THAT(refused("0,0,0,5,0,0,0\n1,2,3\n"), Catch::Contains("path.csv:2: is not a row of numbers time,eye_x"));
  CHECK_THAT(refused("time,x\n0,0,0,5,0,0,nan\n"), Catch::Contains("path.csv:2: is not a row"));
  CHECK_THAT(refused("1,0,0,5,0,0,0\n1,0,0,6,0,0,0\n"),
             Catch::Contains("path.csv:2: its time 1 does not come after 1"));
  CHECK_THAT(refused("1,0,0,5,0,0,5\n"), Catch::Contains("path.csv:1: the eye and the point looked at are the same"));
  CHECK_THAT(refused("1,0,0,5,0,0,0,190\n"), Catch::Contains("between 0 and 170 degrees"));
  CHECK_THAT(refused("time\n"), Catch::Contains("has no rows"));
  CHECK_THAT(message_of([&] { read_camera_path(scratch.folder / "no.csv", CurveForm::smooth); }),
             Catch::Contains("no.csv: cannot be read"));
}

TEST_CASE("a turntable turns round one frame, or along the frames") {
  const ScratchRun scratch;
  for (const int number : {0, 1}) store(scratch, ball(12, number));
  RenderOptions options = small(scratch);
  options.turntable = 4;
  options.frames = "1";
  options.plain = true;
  CHECK(render_run(options, silent).pictures == 4);
  const fs::path out = scratch.folder / "pictures";
  const Image first = read_png(out / "turn.0000.png"), third = read_png(out / "turn.0002.png");
  CHECK(first.rgb != third.rgb);  // the ball is not in the middle
  options.frames = "all";
  const Job job = prepare_job(options, silent);
  const std::vector<Shot> shots = shots_of(job);
  REQUIRE(shots.size() == 2);
  CHECK(shots[1].frame == 1);
  CHECK(shots[1].degrees == 90);
}

TEST_CASE("without ground pictures have alpha: none in the sky, all on solids, and shadows below") {
  const ScratchRun scratch;
  store(scratch, ball(16, 0));
  RenderOptions options = small(scratch);
  options.transparent = true;
  options.material = "milk";
  options.plain = true;
  options.camera = CameraSpec{{0.7f, 1.2f, 3.5f}, {0.7f, 0.5f, 0.5f}, 25};
  const Image image = draw_one(scratch, options);
  REQUIRE(image.alpha.size() == std::size_t(200) * 150);
  CHECK(image.alpha[100] == 0);                            // sky
  CHECK(image.alpha[std::size_t(75) * 200 + 100] == 255);  // the ball
  int shaded = 0;
  for (const std::uint8_t alpha : image.alpha) shaded += alpha > 60 && alpha < 250;
  CHECK(shaded > 200);  // the ball's shadow on the ground
}

TEST_CASE("liquids differ in colour: honey is not blue, milk is white, mercury mirrors") {
  const ScratchRun scratch;
  store(scratch, ball(16, 0));
  RenderOptions options = small(scratch);
  options.plain = true;
  options.camera = CameraSpec{{0.7f, 1.0f, 3.0f}, {0.7f, 0.5f, 0.5f}, 16};
  const auto color = [&](const std::string& material) {
    options.material = material;
    return middle_of(draw_one(scratch, options));
  };
  const Vec3f water = color("water"), honey = color("honey"), milk = color("milk"), blood = color("blood");
  CHECK(water[2] > water[0] + 30);
  CHECK(honey[0] > honey[2] + 60);
  CHECK(milk.minCoeff() > 150);
  CHECK(blood[0] > 2 * blood[2]);
  CHECK((color("mercury") - milk).norm() > 30);
}

TEST_CASE("light comes back from EXR as it was, to half precision") {
  const ScratchRun scratch;
  Canvas canvas(7, 5, Vec3f::Zero());
  canvas.alpha.resize(35);
  for (int i = 0; i < 35; ++i) {
    canvas.pixels[std::size_t(i)] = Vec3f(0.001f * float(i), 3.7f * float(i), 1.0f / float(i + 1));
    canvas.alpha[std::size_t(i)] = float(i) / 34;
  }
  const fs::path file = scratch.folder / "light.exr";
  write_exr(file, canvas);
  const Canvas back = read_exr(file);
  REQUIRE(back.width == 7);
  REQUIRE(back.height == 5);
  REQUIRE(back.alpha.size() == 35);
  for (std::size_t i = 0; i < 35; ++i) {
    // half has 11 bits, of which rounding takes half of the last: 2^-11 of a value
    CHECK((back.pixels[i] - canvas.pixels[i]).norm() <= 4.9e-4f * canvas.pixels[i].norm() + 1e-7f);
    CHECK(back.alpha[i] == Approx(canvas.alpha[i]).epsilon(4.9e-4));
  }
  canvas.alpha.clear();
  write_exr(file, canvas);
  CHECK(read_exr(file).alpha.empty());
  write_file(file, "no picture");
  CHECK_THAT(message_of([&] { read_exr(file); }), Catch::Contains("not a readable EXR"));
}

TEST_CASE("EXR pictures of a run hold light beyond white") {
  const ScratchRun scratch;
  store(scratch, ball(16, 0));
  RenderOptions options = small(scratch);
  options.format = Format::exr;
  options.camera = CameraSpec{{0.5f, 3, 0.5f}, {0.5f, 9, 0.4f}, 110};  // the sun stands 32 degrees from the zenith
  render_run(options, silent);
  const Canvas canvas = read_exr(scratch.folder / "pictures" / "frame.0000.exr");
  float brightest = 0;
  for (const Vec3f& pixel : canvas.pixels) brightest = std::max(brightest, pixel.maxCoeff());
  CHECK(canvas.width == 200);
  CHECK(brightest > 1.0f);
}

}  // namespace cameras_tests
