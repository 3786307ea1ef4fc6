// Sources that move: with a solid, or by formulas.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/solid_spec.h"
#include "volume_scenes.h"

namespace moving_sources_tests {
using namespace seiche;
using test::box_scene;

namespace {

// Centre of the liquid, from the shares that the level set gives, m.
Vec3 centre_of_liquid(const Simulation& sim, const Scene& s) {
  const FrameField f = sim.frame_field("surface");
  const double h = s.domain.cell_size;
  Vec3 sum = Vec3::Zero();
  double liquid = 0;
  std::size_t n = 0;
  for (int k = f.lower[2]; k < f.upper[2]; ++k)
    for (int j = f.lower[1]; j < f.upper[1]; ++j)
      for (int i = f.lower[0]; i < f.upper[0]; ++i, ++n) {
        const double share = std::clamp(0.5 - f.values[n] / h, 0.0, 1.0);
        sum += share * h * Vec3(i + 0.5, j + 0.5, k + 0.5);
        liquid += share;
      }
  return sum / liquid;
}

LiquidSourceSpec nozzle(int dim) {
  LiquidSourceSpec source;
  source.shape.kind = "sphere", source.shape.where = "test";
  source.shape.center = {0.3, 0.5, dim == 2 ? 0 : 0.5}, source.shape.radius = 0.1;
  return source;
}

}  // namespace

// Without gravity, a drop that a source keeps full moves with it, by formulas and with a solid of the same motion.
TEST_CASE("moving sources: a source takes its liquid along", "[sources]") {
  for (const int dim : {2, 3})
    for (const bool attached : {false, true}) {
      Scene s = box_scene(dim, dim == 2 ? 40 : 20);
      LiquidSourceSpec source = nozzle(dim);
      MotionSpec motion;
      motion.translate[0] = "0.4*t";
      if (attached) {
        SolidSpec& carrier = s.solids.emplace_back();
        carrier.name = "carrier", carrier.kind = SolidKind::kinematic;
        carrier.shape.kind = "sphere", carrier.shape.where = "test";
        carrier.shape.center = {0.3, 0.8, dim == 2 ? 0 : 0.5}, carrier.shape.radius = 0.1;
        carrier.motion = motion;
        source.attached_to = "carrier";
      } else {
        source.motion = motion;
      }
      s.liquid.sources.push_back(source);
      const auto sim = make_simulation(s, Communicator());
      while (sim->time() < 1 - 1e-9) (void)sim->step(1);
      const Vec3 centre = centre_of_liquid(*sim, s);
      const double drop = dim == 2 ? M_PI * 0.01 : 4.0 / 3 * M_PI * 0.001;
      WARN(dim << "D: centre " << centre.transpose() << ", " << sim->stats().liquid_volume / drop << " drops");
      CHECK(centre[0] == Approx(0.7).margin(s.domain.cell_size));
      CHECK(centre[1] == Approx(0.5).margin(0.2 * s.domain.cell_size));
      // The first step leaves liquid behind that has no velocity yet: a crescent a step long, 18 and 24 % of the drop.
      CHECK(sim->stats().liquid_volume > drop);
      CHECK(sim->stats().liquid_volume < 1.3 * drop);
    }
}

// The velocity is against the source and turns with it: after a quarter turn it points along y.
TEST_CASE("moving sources: the velocity turns with the source", "[sources]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, dim == 2 ? 40 : 20);
    LiquidSourceSpec source = nozzle(dim);
    source.shape.center = {0.5, 0.5, dim == 2 ? 0 : 0.5};
    source.velocity[0] = "1";
    source.motion.emplace();
    source.motion->degrees = "90";
    source.motion->center = source.shape.center;
    s.liquid.sources.push_back(source);
    const auto sim = make_simulation(s, Communicator());
    while (sim->time() < 0.3 - 1e-9) (void)sim->step(0.3);
    const Vec3 centre = centre_of_liquid(*sim, s);
    CHECK(centre[0] == Approx(0.5).margin(0.3 * s.domain.cell_size));
    CHECK(centre[1] > 0.6);
  }
}

// A source on a body that falls freely leaves its liquid where it brought it, with the body's velocity: both fall
// alike.
TEST_CASE("moving sources: a source falls with a rigid body", "[sources]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, dim == 2 ? 40 : 20);
    s.gravity = {0, -2, 0};
    s.time.max_step = 0.005;
    SolidSpec& ball = s.solids.emplace_back();
    ball.name = "ball", ball.kind = SolidKind::rigid;
    ball.shape.kind = "sphere", ball.shape.where = "test";
    ball.shape.center = {0.7, 0.8, dim == 2 ? 0 : 0.5}, ball.shape.radius = 0.1;
    ball.rigid.density = 1000;
    LiquidSourceSpec source = nozzle(dim);
    source.shape.center[1] = 0.8;
    source.attached_to = "ball";
    s.liquid.sources.push_back(source);
    const auto sim = make_simulation(s, Communicator());
    while (sim->time() < 0.5 - 1e-9) (void)sim->step(0.5);
    const double fallen = 0.5 * 2 * 0.25;
    CHECK(sim->solids()[0].position[1] == Approx(0.8 - fallen).margin(2e-3));  // the steps of free fall
    WARN(dim << "D: ball " << sim->solids()[0].position[1] << ", liquid " << centre_of_liquid(*sim, s)[1]);
    CHECK(centre_of_liquid(*sim, s)[1] == Approx(0.8 - fallen).margin(s.domain.cell_size));
  }
}

}  // namespace moving_sources_tests
