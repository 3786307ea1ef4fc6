// Measures of frames, on fields with known results.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "unit/files/scratch.h"
#include "validate/measure/contour.h"
#include "validate/measure/frames.h"
#include "validate/measure/lines.h"
#include "validate/measure/measures.h"

namespace frames_tests {
using namespace seiche;

namespace {

// n x n cells of the unit square with u(axis, x) on faces and phi(x) in cells.
vdb::Frame square_frame(int n, const std::function<double(int, const Vec3&)>& u,
                        const std::function<double(const Vec3&)>& phi) {
  vdb::Frame frame;
  frame.dimension = 2;
  frame.cell_size = 1.0 / n;
  frame.time = 0.5;
  vdb::Block velocity{{0, 0, 0}, {n, n, 1}, {}}, surface = velocity;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double h = frame.cell_size;
      velocity.values.push_back(float(u(0, {i * h, (j + 0.5) * h, 0})));
      velocity.values.push_back(float(u(1, {(i + 0.5) * h, j * h, 0})));
      velocity.values.push_back(0);
      surface.values.push_back(float(phi({(i + 0.5) * h, (j + 0.5) * h, 0})));
    }
  frame.grids.push_back({"vel", vdb::GridKind::staggered_vector, 0, {velocity}});
  frame.grids.push_back({"surface", vdb::GridKind::level_set, float(3 * frame.cell_size), {surface}});
  return frame;
}

double none(const Vec3&) {
  return 1;
}

LineExtreme line(int component, int along, const Vec3& point, LineExtreme::Kind kind) {
  return {component, along, point, kind, 0};
}

}  // namespace

// The faces of one half count along x, all along y: means are taken for each axis separately.
TEST_CASE("velocities are compared where the region says") {
  const auto frame = square_frame(
      16, [](int a, const Vec3& x) { return a == 0 ? (x[0] < 0.5 ? 3 : 7) : 4.0; }, none);
  const VectorFormula still{"0", "0", "0"};
  CHECK(velocity_difference(frame, still, "x-0.49") == Approx(5));
  CHECK(velocity_difference(frame, {"3", "4", "0"}, "x-t") < 1e-12);
  CHECK(velocity_difference(frame, {"3", "0", "0"}, "x-0.49") == Approx(4));
  CHECK(velocity_difference(frame, still, "-1") == Approx(std::sqrt((9.0 + 49) / 2 + 16)));
  CHECK_THROWS_WITH(velocity_difference(frame, still, "1"), "no face lies in the region");
  CHECK(largest_velocity_difference(frame, still, "x-0.49") == Approx(4));
  CHECK(largest_velocity_difference(frame, {"0", "4", "0"}, "-1") == Approx(7));
  CHECK_THROWS_WITH(largest_velocity_difference(frame, still, "1"), "no face lies in the region");
}

TEST_CASE("extremes along lines are found between the samples") {
  const auto wave = [](int a, const Vec3& x) {
    return a == 0 ? -std::sin(3.0 * x[1]) * (1 + x[0]) : 0.25 - std::pow(x[0] - 0.3, 2);
  };
  const auto frame = square_frame(64, wave, none);
  using Kind = LineExtreme::Kind;
  const auto lowest = extreme_along(frame, line(0, 1, {0.5, 9, 0}, Kind::min));
  CHECK(lowest.value == Approx(-1.5).epsilon(1e-6));  // fourth order in h
  CHECK(lowest.place == Approx(std::acos(0.0) / 3).margin(1e-5));
  CHECK(extreme_along(frame, line(0, 1, {0.51, 9, 0}, Kind::min)).value == Approx(-1.51).epsilon(1e-6));
  const auto highest = extreme_along(frame, line(1, 0, {9, 0.5, 0}, Kind::max));
  CHECK(highest.value == Approx(0.25).epsilon(1e-6));
  CHECK(highest.place == Approx(0.3).margin(1e-5));  // 32-bit round-off at a flat maximum
  const auto last = extreme_along(frame, line(1, 0, {9, 0.5, 0}, Kind::min));
  CHECK(last.value == Approx(0.25 - std::pow(1 - 0.5 / 64 - 0.3, 2)).epsilon(1e-6));  // the last sample
  CHECK(last.place == 1 - 0.5 / 64);
  auto moved = square_frame(
      64, [](int, const Vec3& x) { return -std::pow(x[0] - 0.3, 2); }, none);
  moved.lower = Vec3(2, 5, 0);
  CHECK(extreme_along(moved, line(0, 0, {9, 5.5, 0}, Kind::max)).place ==
        Approx(2.3).margin(1e-5));  // on faces along x
}

// psi = -(1 - (x - 0.37)^2) y (1 - y)^2. Its extreme is a third of a cell off the corners. Relative errors: 0.5 h^2
// from the sums; 0.1 and 0.75 h^2 more without the parabolas along x and y.
TEST_CASE("the stream function is what flows between a corner and the lower wall") {
  const auto vortex = [](int a, const Vec3& x) {
    const double along = 1 - std::pow(x[0] - 0.37, 2);
    return a == 0 ? -along * (1 - x[1]) * (1 - 3 * x[1]) : -2 * (x[0] - 0.37) * x[1] * std::pow(1 - x[1], 2);
  };
  for (const int n : {16, 64}) {
    INFO(n);
    CHECK(stream_function_extreme(square_frame(n, vortex, none)) == Approx(-4.0 / 27).epsilon(0.6 / (n * n)));
  }
  auto frame = square_frame(8, vortex, none);
  frame.dimension = 3;
  CHECK_THROWS_WITH(stream_function_extreme(frame), Catch::Contains("2D"));
}

TEST_CASE("extremes to compare with are read from CSV") {
  const auto lines =
      csv_extremes("# source\ncomponent,along,x,y,z,extreme,value\nx,y,0.5,0,0,min,-0.25\ny,x,0,0.5,0,max,2\n");
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].component == 0);
  CHECK(lines[0].along == 1);
  CHECK(lines[0].point == Vec3(0.5, 0, 0));
  CHECK(lines[0].kind == LineExtreme::Kind::min);
  CHECK(lines[0].value == -0.25);
  CHECK(lines[1].kind == LineExtreme::Kind::max);
  const std::string header = "component,along,x,y,z,extreme,value\n";
  for (const char* wrong : {"", "x,y,0,0,0,min\n", "w,y,0,0,0,min,1\n", "x,y,0,0,0,most,1\n", "x,y,0,0,0,min,one\n"})
    CHECK_THROWS_AS(csv_extremes(header + wrong), Error);
  CHECK_THROWS_WITH(csv_extremes("along,component,x,y,z,extreme,value\nx,y,0,0,0,min,1\n"),
                    Catch::Contains("is to be component,along"));
}

// A cubic is reproduced between the faces up to the round-off of floats. A line beside its faces is interpolated
// linearly between them.
TEST_CASE("a profile along a line is a cubic through the faces") {
  const auto cubic = [](double y) { return 1 - 3 * y + 2 * y * y - 5 * y * y * y; };
  const auto frame = square_frame(
      16, [&](int a, const Vec3& x) { return a == 0 ? cubic(x[1]) + x[0] : 0.0; }, none);
  for (const double y : {1.0 / 32, 0.04, 0.33, 0.5, 0.9, 31.0 / 32})
    CHECK(value_along(frame, {0, 1, {0.51, y, 0}, 0}) == Approx(cubic(y) + 0.51).margin(1e-6));
  CHECK_THROWS_WITH(value_along(frame, {0, 1, {0.5, 0.03, 0}, 0}), Catch::Contains("no samples around"));
  CHECK_THROWS_AS(value_along(frame, {0, 1, {0.5, 0.98, 0}, 0}), Error);
  CHECK_THROWS_AS(value_along(frame, {0, 1, {1.1, 0.5, 0}, 0}), Error);
  CHECK_THROWS_AS(value_along(frame, {0, 1, {-0.1, 0.5, 0}, 0}), Error);
}

TEST_CASE("profiles to compare with are read from CSV") {
  const auto points = csv_profile("# source\ncomponent,along,x,y,z,value\r\nx,y,0.5,0.1,0,-0.25\r\ny,x,0.2,0.5,0,2\n");
  REQUIRE(points.size() == 2);
  CHECK(points[1].component == 1);
  CHECK(points[1].along == 0);
  CHECK(points[1].point == Vec3(0.2, 0.5, 0));
  CHECK(points[1].value == 2);
  const std::string header = "component,along,x,y,z,value\n";
  for (const char* wrong : {"", "x,y,0.5,0.1,0\n", "x,y,0.5,0.1,0,min,2\n", "x,y,0.5,a,0,2\n"})
    CHECK_THROWS_AS(csv_profile(header + wrong), Error);
  CHECK_THROWS_WITH(csv_profile("x,y,0.5,0.1,0,2\nx,y,0.5,0.2,0,2\n"), Catch::Contains("is to be component,along"));
}

TEST_CASE("a surface is compared with a formula near it alone") {
  const auto frame = square_frame(
      32, [](int, const Vec3&) { return 0.0; }, [](const Vec3& x) { return x[1] - 0.5 > 0.04 ? 9 : x[1] - 0.51; });
  CHECK(surface_difference(frame, "y-t") == Approx(0.01).epsilon(1e-5));
  CHECK(surface_difference(frame, "y-0.51") < 1e-6);  // 32-bit round-off
  CHECK_THROWS_AS(surface_difference(square_frame(
                                         8, [](int, const Vec3&) { return 0.0; }, none),
                                     "y"),
                  Error);
}

// Circularity of a circle: 1; of a square: sqrt(pi)/2; of two equal circles: 1/sqrt(2). Inside and outside give the
// same.
TEST_CASE("circularity of outlines") {
  const auto still = [](int, const Vec3&) { return 0.0; };
  const auto circle = [](double x0, double r) {
    return [=](const Vec3& x) { return std::hypot(x[0] - x0, x[1] - 0.507) - r; };
  };
  const auto of = [&](int n, const std::function<double(const Vec3&)>& phi) {
    return circularity(square_frame(n, still, phi));
  };
  const auto whole = circle(0.491, 0.25);
  const double coarse = 1 - of(40, whole), fine = 1 - of(80, whole);
  CHECK(std::abs(fine) < 1e-4);
  CHECK(std::abs(fine) < 0.35 * std::abs(coarse));  // second order: 0.25
  CHECK(of(80, [&](const Vec3& x) { return -whole(x); }) == Approx(1 - fine).epsilon(1e-6));
  const auto square = [](const Vec3& x) { return std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) - 0.303; };
  CHECK(of(80, square) == Approx(0.5 * std::sqrt(3.14159265358979)).epsilon(0.01));  // corners are cut off by the grid
  const auto left = circle(0.25, 0.15), right = circle(0.75, 0.15);
  CHECK(of(80, [&](const Vec3& x) { return std::min(left(x), right(x)); }) == Approx(std::sqrt(0.5)).epsilon(1e-3));
  CHECK_THROWS_WITH(of(16, [](const Vec3& x) { return x[1] - 0.5; }), Catch::Contains("domain's sides"));
  CHECK_THROWS_WITH(of(16, none), Catch::Contains("no surface"));
}

TEST_CASE("the least circularity of the frames in a time is measured") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::filesystem::create_directories(run.frames());
  for (int n = 0; n < 4; ++n) {
    auto frame = square_frame(
        40, [](int, const Vec3&) { return 0.0; },
        [&](const Vec3& x) { return std::hypot(x[0] - 0.5, (1 + 0.2 * n) * (x[1] - 0.5)) - 0.25; });
    frame.time = n;
    put(run.frames() / fmt::format("frame.{:04}.vdb", n), vdb::encode(frame));
  }
  MeasureSpec spec;
  spec.kind = "circularity";
  spec.from = 0;
  spec.to = 2;
  spec.reference = "1";
  const Measurement least = measure(spec, run);
  CHECK(least.error == Approx(1 - least.value));
  CHECK(measured_series(spec, run).size() == 4);
  CHECK(measured_series(spec, run)[2].second == least.value);
  spec.from = spec.to = 0;
  CHECK(measure(spec, run).error < 1e-3);
}

// The circumference of an ellipse with axis ratio 1 + s exceeds that of the circle of equal area by 3 s^2/16 + O(s^3),
// relatively. With s = 0.3 - 0.1 (t - 1.2)^2 the circularity is lowest at t = 1.2, and the parabola through the exact
// values at 0.6, 1 and 1.6 has its vertex at 1.198. An error of 1e-4, as with 40 cells, moves it by 0.02.
TEST_CASE("the time of the least circularity is found between frames") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::filesystem::create_directories(run.frames());
  for (const double t : {0.0, 0.6, 1.0, 1.6, 2.0}) {
    const double ratio = 1.3 - 0.1 * (t - 1.2) * (t - 1.2);
    auto frame = square_frame(
        40, [](int, const Vec3&) { return 0.0; },
        [&](const Vec3& x) { return std::hypot(x[0] - 0.5, ratio * (x[1] - 0.5)) - 0.25; });
    frame.time = t;
    put(run.frames() / fmt::format("frame.{:04}.vdb", std::lround(10 * t)), vdb::encode(frame));
  }
  MeasureSpec spec;
  spec.kind = "circularity_time";
  spec.from = 0;
  spec.to = 2;
  spec.reference = "1.2";
  CHECK(measure(spec, run).value == Approx(1.2).margin(0.02));
  CHECK(measure(spec, run).error == Approx(std::abs(measure(spec, run).value / 1.2 - 1)).margin(1e-15));
  spec.to = 1.0;
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("first or last"));
}

// Discs of radius 0.25 and 0.3, and one shifted by 0.1. Two discs d apart differ by twice 2 r^2 asin(d/2r) + d sqrt(r^2
// - d^2/4). The frame's disc, linear between cells, lacks the segments between chords and arc: h^2/12 R of its area,
// 1/500.
TEST_CASE("the area between two surfaces is found to a few thousandths of a disc") {
  const auto frame = square_frame(
      32, [](int, const Vec3&) { return 0.0; }, [](const Vec3& x) { return (x - Vec3(0.5, 0.5, 0)).norm() - 0.25; });
  const double disc = 3.14159265358979 * 0.25 * 0.25, d = 0.1, r = 0.25;
  CHECK(surface_misplaced(frame, "sqrt((x-0.5)^2+(y-0.5)^2)-0.25") < 3e-3 * disc);
  CHECK(surface_misplaced(frame, "sqrt((x-0.5)^2+(y-0.5)^2)-0.25-0.1*t") ==
        Approx(3.14159265358979 * (0.09 - 0.0625)).margin(3e-3 * disc));
  const double lunes = 2 * (2 * r * r * std::asin(d / (2 * r)) + d * std::sqrt(r * r - d * d / 4));
  CHECK(surface_misplaced(frame, "sqrt((x-0.6)^2+(y-0.5)^2)-0.25") == Approx(lunes).margin(3e-3 * disc));
  CHECK(surface_misplaced(frame, "1") == Approx(disc).margin(3e-3 * disc));
}

TEST_CASE("the worst of several extremes is the error of a run") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::filesystem::create_directories(run.frames());
  const auto frame = square_frame(
      32, [](int a, const Vec3& x) { return a == 0 ? std::sin(3 * x[1]) : 2 * std::sin(3 * x[0]); }, none);
  put(run.frames() / "frame.0001.vdb", vdb::encode(frame));
  put(folder.path() / "extremes.csv", "component,along,x,y,z,extreme,value\nx,y,0.5,0,0,max,1\ny,x,0,0.5,0,max,2.5\n");
  MeasureSpec spec;
  spec.kind = "line_extrema";
  spec.data = folder.path() / "extremes.csv";
  CHECK(measure(spec, run).error == Approx(0.2).epsilon(1e-4));
}

TEST_CASE("a solid's column is measured by its peak and its period in a time") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::string text = "time,name,fx,fy\n0,disc,50,0\n";
  for (double t = 0.01; t < 3; t += 0.01)
    text += fmt::format("{},disc,{},{}\n{},other,9,9\n", t, -2 + std::sin(4 * t), std::cos(10 * t), t);
  put(run.solids(), text);
  MeasureSpec spec;
  spec.solid = "disc";
  spec.from = 1;
  spec.to = 2.9;
  spec.kind = "solid_peak";
  spec.column = "fx";
  spec.reference = "-3";
  CHECK(measure(spec, run).error < 1e-3);  // samples 0.01 s apart
  CHECK(measure(spec, run).value < 0);
  spec.kind = "solid_period";
  spec.column = "fy";
  spec.reference = "2*pi/10";
  CHECK(measure(spec, run).error < 1e-3);
}

}  // namespace frames_tests
