// Liquid that enters through a side with all velocity components and then falls freely.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace jets_tests {
using namespace seiche;

namespace {

constexpr double g = 9.81, lower = 0.5, upper = 0.6;  // m/s^2; rims of the jet at the side, m

// A domain of 1 m x 1 m of air. A jet 0.1 m wide (3D: 0.1 m square) enters at x = 0.
Scene jet_scene(int dim, int cells, const Vec3& v, double cfl) {
  Scene s = test::box_scene(dim, cells);
  s.gravity = {0, -g, 0};
  if (dim == 3) s.domain.cells[2] = cells * 3 / 10, s.domain.upper[2] = 0.3;
  const std::string here = dim == 2 ? "y > 0.5 && y < 0.6" : "y > 0.5 && y < 0.6 && z > 0.1 && z < 0.2";
  const auto within = [&](double value) { return Formula(fmt::format("({}) ? {} : 0", here, value)); };
  s.domain.sides[0][0] = {SideType::inflow, {within(v[0]), within(v[1]), within(v[2])}, "0"};
  s.domain.sides[0][1].type = s.domain.sides[1][0].type = SideType::outflow;
  s.time.cfl = cfl;
  s.time.frame_rate = 1;
  return s;
}

struct JetErrors {
  double rim = 0;                // distance from the free parabola, cells
  std::array<double, 3> inside;  // error of the velocity in the first cells, relative to the speed
  double fastest = 0;            // m/s
};

// Columns of cells in the plane through the jet's middle.
JetErrors measure_jet(const Scene& scene, const Vec3& v, double t) {
  const auto sim = make_simulation(scene, Communicator());
  while (sim->time() < t) (void)sim->step(t);
  const FrameField phi = sim->frame_field("surface"), u = sim->frame_field("vel");
  const int nx = scene.domain.cells[0], ny = scene.domain.cells[1], k = scene.dimension == 3 ? ny * 3 / 20 : 0;
  const double h = scene.domain.cell_size;
  const auto cell = [&](int i, int j) { return std::size_t(i + nx * (j + ny * k)); };
  JetErrors e;
  e.inside.fill(0);
  e.fastest = sim->stats().max_speed;
  for (int i = 0; (i + 4) * h < v[0] * t; ++i) {
    const double s = (i + 0.5) * h / v[0], fallen = v[1] * s - g * s * s / 2;
    std::vector<double> rims;
    for (int j = 0; j + 1 < ny; ++j) {
      const double a = phi.values[cell(i, j)], b = phi.values[cell(i, j + 1)];
      if ((a < 0) != (b < 0)) rims.push_back((j + 0.5 + a / (a - b)) * h);
    }
    REQUIRE(rims.size() == 2);
    e.rim = std::max({e.rim, std::abs(rims[0] - lower - fallen) / h, std::abs(rims[1] - upper - fallen) / h});
  }
  const int j = int((lower + upper) / 2 / h);
  for (int a = 0; a < scene.dimension; ++a) {
    const double s = a == 0 ? 0 : 0.5 * h / v[0], exact = v[a] - (a == 1 ? g * s : 0);
    e.inside[std::size_t(a)] = std::abs(u.values[3 * cell(0, j) + std::size_t(a)] - exact) / v.norm();
  }
  return e;
}

// Error of v in a full box. Liquid enters with (1, sin 2 pi t) and passes through: v(x, t) = sin 2 pi (t - x).
double passing_error(int cells, double cfl) {
  Scene s = test::box_scene(2, cells);
  s.domain.sides[1][0].type = s.domain.sides[1][1].type = SideType::periodic;
  s.domain.sides[0][0] = {SideType::inflow, {"1", "sin(2*3.14159265358979*t)", "0"}, "0"};
  s.domain.sides[0][1].type = SideType::outflow;
  test::add_liquid(s, "-1");
  s.liquid.velocity[0] = "1";
  s.time.cfl = cfl;
  s.time.frame_rate = 1;
  constexpr double end = 1.5, pi = 3.14159265358979;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < end) (void)sim->step(end);
  const FrameField u = sim->frame_field("vel");
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    sum += std::pow(u.values[3 * std::size_t(i) + 1] - std::sin(2 * pi * (end - (i + 0.5) / cells)), 2) / cells;
  return std::sqrt(sum);
}

// Liquid leaves a source of 0.2 m x 0.1 m (3D: 0.1 m deep) at v along x, without gravity. Returns the places (cells) of
// its tail and its front off those of liquid that drifts, 0 and v t, in the middle of the jet.
std::pair<double, double> ends_of_source(int dim, double v, double cfl, double t) {
  constexpr int cells = 40;
  Scene s = test::box_scene(dim, cells);
  if (dim == 3) s.domain.cells[2] = 12, s.domain.upper[2] = 0.3;
  LiquidSourceSpec source;
  source.shape.kind = "box";
  source.shape.lower = Vec3(0.2, 0.45, 0.1), source.shape.upper = Vec3(0.4, 0.55, 0.2);
  source.shape.where = "test";
  source.velocity[0] = fmt::format("{}", v);
  s.liquid.sources.push_back(source);
  s.time.cfl = cfl;
  s.time.frame_rate = 1;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < t) (void)sim->step(t);
  const FrameField phi = sim->frame_field("surface");
  const double h = s.domain.cell_size;
  std::vector<double> ends;
  for (int i = 0; i + 1 < cells; ++i) {
    const std::size_t row = std::size_t(cells * (cells / 2 + cells * (dim == 3 ? 6 : 0)));
    const double a = phi.values[row + std::size_t(i)], b = phi.values[row + std::size_t(i) + 1];
    if ((a < 0) != (b < 0)) ends.push_back(i + 0.5 + a / (a - b));
  }
  REQUIRE(ends.size() == 2);
  return {ends[0] - 0.2 / h, ends[1] - (0.4 + v * t) / h};
}

}  // namespace

// Liquid is there from the first step on, neither late nor early by a step. Redistancing rounds the front's corners,
// by a third of a cell after twelve cells.
TEST_CASE("liquid of a source drifts on with its velocity, and begins where the source does") {
  const auto check = [](int dim, double cfl, double t) {
    const auto [tail, front] = ends_of_source(dim, 3, cfl, t);
    WARN(dim << "D, cfl " << cfl << ", t " << t << " s: tail " << tail << ", front " << front << " cells off");
    CHECK(std::abs(tail) < 0.1);
    CHECK(std::abs(front) < 0.5);
  };
  for (const double cfl : {0.5, 1.0, 2.0}) {
    check(2, cfl, 0.01);  // of a cell's crossing
    check(2, cfl, 0.1);
  }
  check(3, 1, 0.05);
}

// The jet is eight cells wide, four in the last case, which follows it until it lands. Its rims are accurate to a cell,
// velocities near the side to 1 % of the speed.
TEST_CASE("a jet enters with the velocity of its side and follows the free parabola") {
  const auto check = [](int dim, const Vec3& v, double cfl, double t, int cells = 80) {
    const Scene scene = jet_scene(dim, cells, v, cfl);
    const JetErrors e = measure_jet(scene, v, t);
    const double drop = std::max(0.0, g * t * t / 2 - v[1] * t), free_fall = std::sqrt(v.squaredNorm() + 2 * g * drop);
    WARN(dim << "D, (" << v[0] << ", " << v[1] << ", " << v[2] << ") m/s, cfl " << cfl << ": rim " << e.rim
             << " cells, velocity " << e.inside[0] << ", " << e.inside[1] << ", " << e.inside[2] << ", fastest "
             << e.fastest << " m/s, in free fall " << free_fall);
    CHECK(e.rim < 1);
    for (const double inside : e.inside) CHECK(inside < 0.01);
    CHECK(e.fastest < 1.05 * free_fall);
  };
  for (double cfl : {1.0, 2.0}) {
    check(2, {3, 0, 0}, cfl, 0.3);
    check(2, {3, 2, 0}, cfl, 0.3);
    check(2, {3, -1, 0}, cfl, 0.18);
  }
  check(3, {3, 2, 0.5}, 1, 0.05);
  check(3, {3, -1, 0}, 1, 0.18, 40);
}

TEST_CASE("liquid comes in with the velocity that the side had when it did") {
  for (double cfl : {0.8, 1.7}) {
    const double coarse = passing_error(16, cfl), middle = passing_error(32, cfl), fine = passing_error(64, cfl);
    WARN("cfl " << cfl << ": " << coarse << ", " << middle << ", " << fine << ", orders " << test::order(coarse, middle)
                << ", " << test::order(middle, fine));
    CHECK(test::order(middle, fine) > 1.5);
  }
}

}  // namespace jets_tests
