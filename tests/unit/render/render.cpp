#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "base/error.h"
#include "render/axes.h"
#include "render/outline.h"
#include "render/run.h"
#include "render/trace.h"

namespace render_tests {
using namespace seiche;
using namespace seiche::render;

namespace {

constexpr float pi = 3.14159265f;

// The unit cube with n^3 cells and the level set of a ball, as in a frame (a band of 3 h).
ScalarVolume ball_level_set(int n, const Vec3f& center, float radius) {
  ScalarVolume phi;
  phi.cells = {n, n, n};
  phi.h = 1.0f / float(n);
  for (int c = 0; c < n * n * n; ++c) {
    const Vec3f x = (Vec3f(float(c % n), float(c / n % n), float(c / (n * n))) + Vec3f::Constant(0.5f)) * phi.h;
    phi.values.push_back(std::clamp((x - center).norm() - radius, -3 * phi.h, 3 * phi.h));
  }
  return phi;
}

// Length of the part 0 <= x <= width of a horizontal line that is inside of polygons, by the even-odd rule.
float inside_of_line(const std::vector<Polygon>& polygons, float y, float width) {
  std::vector<float> crossings;
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2f &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      crossings.push_back(std::clamp(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()), 0.0f, width));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  float sum = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) sum += crossings[i + 1] - crossings[i];
  return sum;
}

SolidMesh random_triangles(int count) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(generator), uniform(generator), uniform(generator)); };
  SolidMesh solids;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = point();
    for (int k = 0; k < 3; ++k) solids.mesh.points.push_back(at + 0.2 * point());
    solids.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    solids.solid.push_back(i % 3);
  }
  return solids;
}

}  // namespace

TEST_CASE("rays meet the level set of a ball where they meet the ball") {
  const Vec3f center(0.47f, 0.52f, 0.5f);
  const float radius = 0.3f;
  const LiquidSurface surface(ball_level_set(40, center, radius));
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int i = 0; i < 500; ++i) {
    const Vec3f origin = center + 2 * Vec3f(uniform(generator), uniform(generator), uniform(generator)).normalized();
    const Vec3f aim = center + 0.25f * Vec3f(uniform(generator), uniform(generator), uniform(generator)).normalized();
    const Ray ray{origin, (aim - origin).normalized()};
    const float middle = (center - origin).dot(ray.direction);
    const float closest = (origin + middle * ray.direction - center).norm();
    const float exact = middle - std::sqrt(radius * radius - closest * closest);
    const Span span = clip(ray, {Vec3f::Zero(), Vec3f::Ones()});
    const float t = surface.first_crossing(ray, span.t0, span.t1);
    // Trilinear interpolation has an error of h^2/(8 R) = 3e-4 in distance, twice that along slanted rays (aim at most
    // 0.25).
    CHECK(t == Approx(exact).margin(1.5e-3));
    CHECK(surface.normal(ray.at(t)).dot((ray.at(t) - center).normalized()) > 0.995f);
  }
}

TEST_CASE("a ball of liquid covers a disc of the right area in the picture") {
  const Vec3f center(0.5f, 0.5f, 0.5f);
  const float radius = 0.3f;
  Stage stage;
  stage.liquid = std::make_unique<LiquidSurface>(ball_level_set(48, center, radius));
  stage.quantity = ball_level_set(48, center, radius);
  for (float& value : stage.quantity->values) value = 0;  // all in the colour of the low end
  stage.scale = {0, 1, "test", &color_map("gray")};
  const int size = 240;
  const Camera camera = make_camera({{0.5f, 4.5f, 0.5f}, center, 20}, Vec3f::UnitX(), size, size);
  light_stage(stage, -camera.forward);
  const Canvas canvas = trace_picture(stage, camera);
  stage.liquid.reset();  // the ground and its shadow remain
  const Canvas without = trace_picture(stage, camera);
  int covered = 0;
  for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
    covered += (canvas.pixels[i] - without.pixels[i]).norm() > 0.02f;
  }
  // The silhouette seen from the distance d = 4 has the slope R / sqrt(d^2 - R^2).
  const float slope = radius / std::sqrt(16 - radius * radius) / camera.slope;
  const float exact = pi * slope * slope * float(size * size) / 4;
  CHECK(float(covered) == Approx(exact).epsilon(0.03));  // 120 pixels across: a rim of half a pixel is 1.7 %
}

TEST_CASE("liquid that fills the domain shows the faces of its walls") {
  Stage stage;
  ScalarVolume full = ball_level_set(8, Vec3f::Zero(), 10);
  stage.liquid = std::make_unique<LiquidSurface>(full);
  stage.quantity = full;
  stage.scale = {-1, 1, "test", &color_map("gray")};
  const Camera camera = frame_box(stage.domain, 1, 160, 120);
  light_stage(stage, -camera.forward);
  const Canvas with = trace_picture(stage, camera);
  stage.liquid.reset();
  const Canvas without = trace_picture(stage, camera);
  // The pictures differ slightly inwards of every corner that faces the camera.
  for (const Vec3f& x : {Vec3f{0.1f, 1, 0.9f}, Vec3f{0.9f, 1, 0.9f}, Vec3f{0.1f, 0.2f, 1}, Vec3f{0.9f, 0.2f, 1}}) {
    const Vec3f p = camera.project(x);
    CHECK((with.at(int(p[0]), int(p[1])) - without.at(int(p[0]), int(p[1]))).norm() > 0.1f);
  }
}

TEST_CASE("the default camera has all corners of the domain in view and fills most of the picture") {
  for (const Vec3f& size : {Vec3f{2, 1, 1}, Vec3f{1, 3, 1}, Vec3f{1, 1, 5}, Vec3f{0.01f, 0.01f, 0.01f}}) {
    for (int up = 0; up < 3; ++up) {
      const Box box{Vec3f(-1, 2, 3), Vec3f(-1, 2, 3) + size};
      const Camera camera = frame_box(box, up, 320, 180);
      float reach = 0;
      for (int i = 0; i < 8; ++i) {
        Vec3f x = box.lower;
        for (int a = 0; a < 3; ++a) x[a] += (i >> a & 1) ? size[a] : 0.0f;
        const Vec3f p = camera.project(x);
        CHECK(p[2] > 0);
        reach = std::max({reach, std::abs(p[0] / 160 - 1), std::abs(p[1] / 90 - 1)});
      }
      CHECK(reach < 0.9f);  // the margin is 0.86
      CHECK(reach > 0.8f);
      CHECK(camera.eye[up] > box.center()[up]);
    }
  }
}

TEST_CASE("the triangle tree finds what a search through all triangles finds") {
  const std::vector<Triangle> triangles = smooth_triangles(random_triangles(700));
  const Bvh tree(triangles);
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Vec3f direction(uniform(generator), uniform(generator), uniform(generator));
    if (i % 10 == 0) direction = Vec3f::Unit(i / 10 % 3);  // rays along the axes
    const Ray ray{1.5f * Vec3f(uniform(generator), uniform(generator), uniform(generator)), direction.normalized()};
    float nearest = 10;
    for (const Triangle& triangle : triangles) {
      const Hit hit = intersect(ray, triangle);
      if (hit.t > 0 && hit.t < nearest) nearest = hit.t;
    }
    const Hit found = tree.closest(ray, 0, 10);
    CHECK(tree.any(ray, 0, 10) == (nearest < 10));
    CHECK((found.t >= 0) == (nearest < 10));
    if (found.t >= 0) CHECK(found.t == nearest);  // the same arithmetic on the same triangle
    hits += found.t >= 0;
  }
  CHECK(hits > 500);
}

TEST_CASE("a ray through a triangle meets it at its barycentric point") {
  const Triangle triangle{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {}, 0};
  const Hit hit = intersect({{-1, 0.5f, 0.75f}, {1, 0, 0}}, triangle);
  CHECK(hit.t == Approx(2));
  CHECK(hit.u == Approx(0.25));
  CHECK(hit.v == Approx(0.25));
  CHECK(intersect({{-1, 1.5f, 1.5f}, {1, 0, 0}}, triangle).t < 0);
}

TEST_CASE("ticks are round numbers that print with the digits they need") {
  CHECK(tick_step(1, 5) == Approx(0.2));
  CHECK(tick_step(0.037, 5) == Approx(0.005));
  CHECK(tick_step(9000, 4) == Approx(2000));
  CHECK(tick_text(0.6000000001, 0.2) == "0.6");
  CHECK(tick_text(-1e-12, 0.2) == "0.0");
  CHECK(tick_text(4000, 2000) == "4000");
  CHECK(tick_text(1.5e-10, 5e-11) == "1.5e-10");
  CHECK(tick_text(2e-10, 1e-10) == "2e-10");
  CHECK(tick_text(0.29992401, 1e-8) == "0.29992401");
  const auto logarithmic = [](double low, double high) {
    std::string text;
    for (const Tick& tick : ticks_of({low, high, 0, 1, "", true}, 6)) text += tick.text + " ";
    return text;
  };
  CHECK(logarithmic(3e-6, 2e-2) == "10⁻⁵ 10⁻⁴ 0.001 0.01 ");
  CHECK(logarithmic(15, 170) == "20 50 100 ");
  CHECK(logarithmic(0.26, 0.33) == "0.26 0.27 0.28 0.29 0.30 0.31 0.32 0.33 ");
}

TEST_CASE("outlines are filled: closed ones, holes, and those that the border of the region cuts") {
  SolidMesh solids;
  const auto chain = [&](const std::vector<Vec3>& points, bool closed) {
    const int first = int(solids.mesh.points.size()), n = int(points.size());
    solids.mesh.points.insert(solids.mesh.points.end(), points.begin(), points.end());
    for (int i = 0; i + 1 < n + closed; ++i) {
      solids.mesh.segments.push_back({first + i, first + (i + 1) % n});
      solids.solid.push_back(0);
    }
  };
  const auto area = [&](const Box& box) {
    double sum = 0;
    const auto polygons = close_outlines(solids, 0, box);
    for (int line = 0; line < 400; ++line) sum += inside_of_line(polygons, (float(line) + 0.5f) / 4, 100) / 4;
    return sum;
  };
  const Box box{Vec3f::Zero(), Vec3f(100, 100, 1)};
  SECTION("a triangle with a square hole") {
    chain({{10, 10, 0}, {90, 10, 0}, {10, 90, 0}}, true);
    chain({{20, 20, 0}, {20, 30, 0}, {30, 30, 0}, {30, 20, 0}}, true);
    CHECK(area(box) == Approx(3200 - 100).epsilon(1e-3));  // four lines per unit are exact for straight sides
  }
  SECTION("the ground below a line") {  // the inside lies to the left: the line runs towards low x
    chain({{100, 40, 0}, {50, 40, 0}, {0, 20, 0}}, false);
    CHECK(area(box) == Approx(50 * 40 + 50 * 30).epsilon(1e-3));
  }
  SECTION("a channel between two lines, which is not solid") {
    chain({{100, 40, 0}, {0, 40, 0}}, false);
    chain({{0, 70, 0}, {100, 70, 0}}, false);
    CHECK(area(box) == Approx(4000 + 3000).epsilon(1e-3));
  }
  SECTION("all but what two outlines turned inside out enclose") {
    chain({{10, 10, 0}, {10, 50, 0}, {50, 50, 0}, {50, 10, 0}}, true);
    CHECK(area(box) == Approx(10000 - 1600).epsilon(1e-3));
    chain({{60, 60, 0}, {60, 90, 0}, {90, 60, 0}}, true);
    CHECK(area(box) == Approx(10000 - 1600 - 450).epsilon(1e-3));
  }
  SECTION("a corner cut off beyond the region") {
    chain({{30, -2, 0}, {-2, 30, 0}}, false);
    CHECK(area(box) == Approx(28 * 28 / 2).epsilon(1e-3));
  }
}

TEST_CASE("options of render are understood or refused with the form they should have") {
  CHECK(parse_size("1280x720") == std::array<int, 2>{1280, 720});
  for (const char* text : {"", "1280", "0x5", "1280x720x2", "1e3x7", "99999x99999"})
    CHECK_THROWS_AS(parse_size(text), Error);
  const CameraSpec camera = parse_camera("1,2,3, 0.5,0,-1e1, 60");
  CHECK(camera.look == Vec3f(0.5f, 0, -10));
  CHECK(camera.degrees == 60);
  for (const char* text : {"", "1,2,3", "1,2,3,4,5,x", "1,2,3,4,5,nan", "1,2,3,4,5,6,7,8"}) {
    CHECK_THROWS_AS(parse_camera(text), Error);
  }
  const std::vector<int> available{0, 1, 2, 3, 10, 11};
  CHECK(choose_frames("all", available) == available);
  CHECK(choose_frames("2-10,0", available) == std::vector<int>{0, 2, 3, 10});
  CHECK(choose_frames("10, 1", available) == std::vector<int>{1, 10});
  for (const char* text : {"4", "0-12", "3-1", "a", "", "1,,2", "-1"})
    CHECK_THROWS_AS(choose_frames(text, available), Error);
  CHECK_THROWS_WITH(choose_frames("7", available), Catch::Contains("the run has 0-3, 10-11"));
}

}  // namespace render_tests
