// A scene scaled in length and time so that its dimensionless numbers stay the same runs alike, from micrometres to
// kilometres. Scales are powers of two, which round nothing.
#include <catch2/catch.hpp>

#include "elastic_scenes.h"
#include "rigid_scenes.h"
#include "scenes.h"

namespace scales_tests {
using namespace seiche;

namespace {

struct Contents {
  bool liquid = true, rigid = false, elastic = false;
};

// Factors on lengths and times. Densities stay: the mass has the unit length^Dim.
struct Scales {
  double length = 1, time = 1;
  explicit Scales(int exponent) : length(std::ldexp(1, 2 * exponent)), time(std::ldexp(1, exponent)) {}
  double speed() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double stress() const { return speed() * speed(); }
  double kinematic_viscosity() const { return length * speed(); }
};

// A column of water collapses. A ball and a tilted box fall onto a block that falls on the floor, or on the floor, and
// rub.
Scene column_and_bodies(int dim, const Contents& contents, const Scales& scales) {
  const double L = scales.length, V = scales.speed();
  Scene s = test::box_scene(dim, dim == 2 ? 16 : 8, L);
  s.gravity = Vec3(0, -10, 0) * scales.acceleration();
  s.time.end = 0.5 * scales.time;
  s.time.frame_rate = 16 / scales.time;
  s.liquid.viscosity = fmt::format("{:.17g}", 2 * scales.kinematic_viscosity());
  if (contents.liquid) {
    LiquidRegionSpec column;
    column.shape.kind = "box";
    column.shape.upper = Vec3(0.5, 0.625, dim == 3 ? 1 : 0) * L;
    column.shape.where = "test";
    s.liquid.regions.push_back(column);
  }
  const auto add = [&](SolidSpec solid, const Vec3& velocity) {
    solid.friction = 0.3;
    solid.rigid.velocity = velocity * V;
    s.solids.push_back(solid);
  };
  const double z = dim == 3 ? 0.5 : 0;
  if (contents.rigid) {
    add(test::rigid_ball("ball", 0.1 * L, Vec3(0.775, 0.34, z) * L, 700), {0.3, -1.5, 0});
    add(test::rigid_box("box", Vec3(0.12, 0.1, 0.2) * L, Vec3(0.6, 0.29, z) * L, 500, 3), {0, -0.5, 0});
  }
  if (contents.elastic)
    add(test::elastic_box("block", Vec3(0.53, 0.01, z - 0.15) * L, Vec3(0.87, 0.22, z + 0.15) * L, 900,
                          {2e4 * scales.stress(), 0.3}, 0.11 * L),
        {0, -0.5, 0});
  return s;
}

// Dimensionless results of each step: length of the step, energies, momenta, places and velocities of solids.
std::vector<Eigen::VectorXd> results(int dim, const Contents& contents, const Scales& scales, int steps) {
  const double mass = std::pow(scales.length, dim), L = scales.length, V = scales.speed();
  const auto sim = make_simulation(column_and_bodies(dim, contents, scales), Communicator());
  std::vector<Eigen::VectorXd> rows;
  int contacts = 0;
  for (int n = 0; n < steps; ++n) {
    const StepStats stats = sim->step(0.5 * scales.time);
    contacts += stats.contacts;
    std::vector<double> row{stats.dt / scales.time, stats.kinetic_energy / (mass * V * V),
                            stats.elastic_energy / (mass * V * V), stats.liquid_volume / std::pow(L, dim),
                            stats.max_speed / V};
    for (int a = 0; a < dim; ++a) row.push_back(stats.momentum[a] / (mass * V));
    for (const SolidState& solid : sim->solids())
      for (int a = 0; a < 3; ++a)
        row.insert(row.end(), {solid.position[a] / L, solid.velocity[a] / V, solid.angular_velocity[a] * scales.time});
    rows.push_back(Eigen::Map<const Eigen::VectorXd>(row.data(), Eigen::Index(row.size())));
  }
  CHECK((contacts > 0) == (contents.rigid || contents.elastic));
  return rows;
}

// Largest difference of a result, relative to the largest size of that result over the steps.
double difference(const std::vector<Eigen::VectorXd>& one, const std::vector<Eigen::VectorXd>& other) {
  Eigen::VectorXd size = Eigen::VectorXd::Constant(one[0].size(), 1e-300), off = 0 * size;
  for (std::size_t n = 0; n < one.size(); ++n) {
    size = size.cwiseMax(one[n].cwiseAbs());
    off = off.cwiseMax((one[n] - other[n]).cwiseAbs());
  }
  return off.cwiseQuotient(size).maxCoeff();
}

void check_scales(int dim, const Contents& contents, int steps, double tolerance) {
  const auto metres = results(dim, contents, Scales(0), steps);
  for (const int exponent : {-10, 5}) {  // lengths by 2^-20 and 2^10
    const double off = difference(metres, results(dim, contents, Scales(exponent), steps));
    WARN(dim << "D, " << (contents.rigid ? "rigid " : "") << (contents.elastic ? "elastic" : "") << ", lengths by "
             << Scales(exponent).length << ": " << off);
    CHECK(off <= tolerance);
  }
}

}  // namespace

TEST_CASE("liquid runs alike from micrometres to kilometres, to the bit") {
  check_scales(2, {.liquid = true}, 10, 0);
  check_scales(3, {.liquid = true}, 5, 0);
}

// Rotations and translations differ in unit; nothing may compare one with the other. Bodies then run alike to the bit,
// too, on one machine. The tolerance leaves room for round-off that contact amplifies; a solver's tolerance is 1e-8.
TEST_CASE("bodies in contact and in liquid run alike from micrometres to kilometres", "[long]") {
  SECTION("rigid, 2D") {
    check_scales(2, {.rigid = true}, 12, 1e-10);
  }
  SECTION("rigid, 3D") {
    check_scales(3, {.rigid = true}, 6, 1e-10);
  }
  SECTION("elastic and rigid, 2D") {
    check_scales(2, {.rigid = true, .elastic = true}, 8, 1e-10);
  }
  SECTION("elastic and rigid, 3D") {
    check_scales(3, {.rigid = true, .elastic = true}, 3, 1e-10);
  }
}

}  // namespace scales_tests
