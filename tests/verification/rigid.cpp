// Rigid bodies in liquid against exact results.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace rigid_tests {
using namespace seiche;

namespace {

Vec3 middle(int dim) {
  return {0.5, 0.5, dim == 3 ? 0.5 : 0.0};
}

SolidSpec ball(int dim, double radius, double density) {
  SolidSpec s;
  s.name = "ball";
  s.kind = SolidKind::rigid;
  s.shape.kind = "sphere";
  s.shape.center = middle(dim);
  s.shape.radius = radius;
  s.shape.where = "test";
  s.rigid.density = density;
  return s;
}

void fill(Scene& s) {
  test::add_liquid(s, "-1");
  s.gravity = {0, -9.81, 0};
}

// Acceleration, over g, in the first step of a ball of radius 1/4 in a concentric, full container of radius 0.45.
double first_acceleration(int dim, int cells, double ratio) {
  Scene s = test::box_scene(dim, cells);
  fill(s);
  s.solids.push_back(ball(dim, 0.25, 1000 * ratio));
  SolidSpec container = ball(dim, 0.45, 0);
  container.name = "container";
  container.kind = SolidKind::fixed;
  container.shape.invert = true;
  s.solids.push_back(container);
  s.time.scheme = TimeScheme::first_order;
  s.time.fixed_step = 1e-3;
  const auto sim = make_simulation(s, Communicator());
  (void)sim->step(1e-3);
  return sim->solids()[0].velocity[1] / (1e-3 * -9.81);
}

// (s - 1)/(s + C), C the added mass in a concentric container (Lamb, Hydrodynamics, 93).
double exact_acceleration(int dim, double ratio) {
  const double a = std::pow(0.25, dim), R = std::pow(0.45, dim);
  const double added = dim == 2 ? (R + a) / (R - a) : (R + 2 * a) / (2 * (R - a));
  return (ratio - 1) / (ratio + added);
}

}  // namespace

TEST_CASE("a ball in a closed container starts as its added mass says", "[long]") {
  for (int dim : {2, 3})
    for (double ratio : {1e-9, 0.1, 0.5, 2.0, 7.8}) {
      const double exact = exact_acceleration(dim, ratio);
      std::vector<double> errors;
      for (int cells : {32, 64}) errors.push_back(std::abs(first_acceleration(dim, cells, ratio) / exact - 1));
      WARN(dim << "D, ratio " << ratio << ": errors " << errors[0] << ", " << errors[1] << ", order "
               << test::order(errors[0], errors[1]));
      CHECK(errors[1] <= 0.02);  // 16 cells per radius
      CHECK(test::order(errors[0], errors[1]) >= 1);
    }
}

TEST_CASE("neutrally buoyant bodies stay at rest in liquid at rest", "[long]") {
  for (int dim : {2, 3}) {
    Scene s = test::box_scene(dim, dim == 2 ? 47 : 23);
    s.gravity = dim == 2 ? Vec3(1.7, -9.6, 0) : Vec3(1.7, -9.6, 2.2);
    test::add_liquid(s, "-1");
    SolidSpec body = ball(dim, 0.13, 1000);
    body.shape.center = {0.3, 0.31, dim == 3 ? 0.35 : 0.0};
    s.solids.push_back(body);
    body.name = "box";
    body.shape.kind = "box";
    body.shape.lower = {-0.11, -0.17, dim == 3 ? -0.13 : 0.0};
    body.shape.upper = {0.11, 0.17, dim == 3 ? 0.13 : 0.0};
    body.shape.transform.rotate = {dim == 2 ? Vec3(0, 0, 1) : Vec3(1, 2, 3), 25};
    body.shape.transform.translate = {0.69, 0.66, dim == 3 ? 0.6 : 0.0};
    s.solids.push_back(body);
    s.solver.tolerance = 1e-13;
    s.time.fixed_step = 0.005;
    const auto sim = make_simulation(s, Communicator());
    double fastest = 0;
    for (int n = 0; n < 100; ++n) {
      fastest = std::max(fastest, sim->step(sim->time() + 1).max_speed);
      for (const SolidState& b : sim->solids())
        fastest = std::max({fastest, b.velocity.norm(), b.angular_velocity.norm()});
    }
    WARN(dim << "D: " << fastest << " m/s");
    CHECK(fastest <= 1e-10);
  }
}

}  // namespace rigid_tests
