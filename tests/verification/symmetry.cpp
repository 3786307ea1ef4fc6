// Rotating, mirroring or permuting the axes of a scene transforms the result alike: no direction is special.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace symmetry_tests {
using namespace seiche;

namespace {

// New axis a is old axis `from[a]`, mirrored if sign[a] < 0.
struct Turn {
  std::string name;
  std::array<int, 3> from;
  std::array<int, 3> sign;
};

Vec3 turned_point(const Turn& t, const Vec3& x, int dim) {
  Vec3 r = Vec3::Zero();
  for (int a = 0; a < dim; ++a) r[a] = t.sign[a] > 0 ? x[t.from[a]] : 1 - x[t.from[a]];
  return r;
}
Vec3 turned_vector(const Turn& t, const Vec3& v, int dim) {
  Vec3 r = Vec3::Zero();
  for (int a = 0; a < dim; ++a) r[a] = t.sign[a] * v[t.from[a]];
  return r;
}

// A blob falls beside a ball onto a pool, with tilted gravity; after some steps it has hit the pool.
Scene scene(const Turn& t, int dim, int n) {
  Scene s = test::box_scene(dim, n);
  const double middle = dim == 3 ? 0.47 : 0;
  s.gravity = turned_vector(t, {1.5, -9.81, dim == 3 ? -0.7 : 0}, dim);
  const auto region = [&](const std::string& kind) -> ShapeSpec& {
    s.liquid.regions.emplace_back();
    s.liquid.regions.back().shape.kind = kind;
    return s.liquid.regions.back().shape;
  };
  ShapeSpec& pool = region("plane");
  pool.point = turned_point(t, {0.5, 0.31, middle}, dim);
  pool.normal = turned_vector(t, {0, 1, 0}, dim);
  ShapeSpec& blob = region("sphere");
  blob.center = turned_point(t, {0.42, 0.62, middle}, dim);
  blob.radius = 0.17;
  s.liquid.regions.back().velocity = VectorFormula{"0", "0", "0"};
  const Vec3 v = turned_vector(t, {0.5, -2, 0}, dim);
  for (int a = 0; a < dim; ++a) (*s.liquid.regions.back().velocity)[a] = fmt::format("{:.17g}", v[a]);
  SolidSpec ball;
  ball.name = "ball";
  ball.shape.kind = "sphere";
  ball.shape.center = turned_point(t, {0.7, 0.35, middle}, dim);
  ball.shape.radius = 0.13;
  s.solids.push_back(ball);
  // The solver's arithmetic depends on the order of the cells, so it iterates to round-off here.
  s.solver.tolerance = 1e-14;
  s.solver.preconditioner = "none";
  s.time.fixed_step = 0.004;
  return s;
}

// Surface and pressure in double precision.
std::array<std::vector<double>, 2> run(const Scene& s, int steps) {
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < steps; ++n) (void)sim->step(sim->time() + 1);
  const CheckpointData data = sim->save();
  REQUIRE(data.fields[0].name == "phi");
  REQUIRE(data.fields[1].name == "pressure");
  return {data.fields[0].values.unpack(), data.fields[1].values.unpack()};
}

// Largest difference between a field and the transformed one, relative to the largest value.
double largest_difference(const Turn& t, const std::vector<double>& plain, const std::vector<double>& turned, int dim,
                          int n) {
  double largest = 0, scale = 0;
  const int depth = dim == 3 ? n : 1;
  for (int k = 0; k < depth; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::array<int, 3> old{i, j, k};
        std::array<int, 3> now{0, 0, 0};
        for (int a = 0; a < dim; ++a) now[a] = t.sign[a] > 0 ? old[t.from[a]] : n - 1 - old[t.from[a]];
        const double p = plain[std::size_t((k * n + j) * n + i)];
        const double q = turned[std::size_t((now[2] * n + now[1]) * n + now[0])];
        largest = std::max(largest, std::abs(p - q));
        scale = std::max(scale, std::abs(p));
      }
  return largest / scale;
}

}  // namespace

TEST_CASE("a turned, mirrored or permuted scene gives the turned result") {
  const Turn plain{"plain", {0, 1, 2}, {1, 1, 1}};
  const std::vector<Turn> turns{{"quarter turn", {1, 0, 2}, {-1, 1, 1}},
                                {"mirrored", {0, 1, 2}, {-1, 1, 1}},
                                {"axes permuted", {1, 2, 0}, {1, 1, 1}}};
  for (int dim : {2, 3}) {
    const int n = dim == 2 ? 32 : 16;
    const auto reference = run(scene(plain, dim, n), 12);
    for (const Turn& t : turns) {
      if (dim == 2 && t.from[0] == 1 && t.from[1] == 2) continue;
      const auto turned = run(scene(t, dim, n), 12);
      const double surface = largest_difference(t, reference[0], turned[0], dim, n);
      const double pressure = largest_difference(t, reference[1], turned[1], dim, n);
      WARN(t.name << " " << dim << "D: relative difference of the surface " << surface << ", of the pressure "
                  << pressure);
      CHECK(surface <= 1e-12);
      CHECK(pressure <= 1e-11);  // the solver's tolerance of 1e-14 times the amplification by a free surface
    }
  }
}

}  // namespace symmetry_tests
