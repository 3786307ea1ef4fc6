// Liquid with a free surface in a vessel that turns steadily turns with it as a solid body, and keeps doing so.
#include <catch2/catch.hpp>

#include "base/fluid_spec.h"
#include "base/scene.h"
#include "base/solid_spec.h"
#include "base/time_spec.h"
#include "rigid_scenes.h"

namespace turning_vessels_tests {
using namespace seiche;

namespace {

// The box [-1.25, 1.25] m along x and y about the axis, with n cells a metre, and liquid of 1000 kg/m^3 and 10 Pa s
// that turns at `rate`, rad/s.
Scene around_axis(int dimension, int n, double rate) {
  Scene s = test::box_scene(dimension, 5 * n / 2, 2.5);
  for (int a = 0; a < 2; ++a) s.domain.lower[a] -= 1.25, s.domain.upper[a] -= 1.25;
  s.liquid.density = 1000;
  s.liquid.viscosity = "10";
  s.liquid.velocity = {fmt::format("-({})*y", rate), fmt::format("({})*x", rate), "0"};
  return s;
}

// The inside of `shape` as a no-slip vessel that turns about the axis.
SolidSpec turning(const ShapeSpec& shape, double rate) {
  SolidSpec s;
  s.name = "vessel";
  s.kind = SolidKind::kinematic;
  s.shape = shape;
  s.shape.invert = true;
  s.shape.where = "test";
  s.slip = Slip::no_slip;
  s.motion.degrees = fmt::format("({})*t", rate * 180 / test::pi);
  return s;
}

double kinetic_energy_at(const Scene& scene, double end) {
  const auto sim = make_simulation(scene, Communicator());
  while (sim->time() < end) sim->step(end);
  return sim->stats().kinetic_energy;
}

}  // namespace

// A ring of liquid, 0.5 m < r < 1 m, at 1 rad/s without gravity: energy per metre rho w^2 pi (1 - 0.5^4)/4. Before the
// acceleration was carried near surfaces, 9.6 and 2.2 % of it were missing (docs/decisions/0030).
TEST_CASE("a turning drum keeps its ring of liquid turning", "[long]") {
  const double exact = 1000 * test::pi * (1 - std::pow(0.5, 4)) / 4;
  const auto missing = [&](int n) {
    Scene s = around_axis(2, n, 1);
    s.time.max_step = 0.4 / n;
    test::add_liquid(s, "0.5-sqrt(x^2+y^2)");
    ShapeSpec drum;
    drum.kind = "sphere";
    drum.radius = 1;
    s.solids.push_back(turning(drum, 1));
    return 1 - kinetic_energy_at(s, 9) / exact;
  };
  const double coarse = missing(8), fine = missing(16);
  INFO("missing share of the energy with 8 and 16 cells a radius: " << coarse << ", " << fine);
  CHECK(std::abs(coarse) < 0.03);  // measured 0.022
  CHECK(std::abs(fine) < 0.004);   // measured 0.0012
}

// A bucket of radius R = 1 m filled to a mean depth of d = 0.8 m at w = 3 rad/s: the surface is the paraboloid
// d + w^2/(2 g) (r^2 - R^2/2), the energy rho w^2 pi ((d - w^2 R^2/(4 g)) R^4/4 + w^2 R^6/(12 g)).
TEST_CASE("a turning bucket keeps its liquid turning", "[long]") {
  const double d = 0.8, w = 3, g = 10;
  const double exact = 1000 * w * w * test::pi * ((d - w * w / (4 * g)) / 4 + w * w / (12 * g));
  Scene s = around_axis(3, 8, w);
  s.domain.cells[2] = 14;
  s.domain.upper[2] = 1.75;
  s.gravity = Vec3(0, 0, -g);
  test::add_liquid(s, "z-0.2-(0.8-0.225+0.45*(x^2+y^2))");
  ShapeSpec bucket;
  bucket.kind = "cylinder";
  bucket.from = {0, 0, 0.2};
  bucket.to = {0, 0, 3};
  bucket.radius = 1;
  s.solids.push_back(turning(bucket, w));
  const double missing = 1 - kinetic_energy_at(s, 2) / exact;
  INFO("missing share of the energy: " << missing);
  CHECK(std::abs(missing) < 0.02);  // measured 0.014; 0.05 before the acceleration was carried near surfaces
}

}  // namespace turning_vessels_tests
