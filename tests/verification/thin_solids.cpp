// Solids thinner than a cell keep liquid on its side, at rest and in motion, at any angle and position on the grid.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace thin_solids_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double thicknesses[] = {0.01, 0.1, 0.3, 0.5, 0.9};  // cells

// A plate that divides the tank. Its first axis is turned by `degrees` about z (3D: and by as much out of the plane).
struct Plate {
  SolidSpec solid;
  Vec3 normal;
  Plate(const Scene& s, double thickness, const Vec3& center, double degrees) {
    const Vec3 axis = s.dimension == 2 ? Vec3(0, 0, 1) : Vec3(0, degrees == 0 ? 0 : 1, 1).normalized();
    solid.name = "plate";
    solid.kind = SolidKind::fixed;
    solid.shape.kind = "box";
    solid.shape.where = "test";
    solid.shape.upper = Vec3(0.5 * thickness * s.domain.cell_size, 3, s.dimension == 2 ? 0 : 3);
    solid.shape.lower = -solid.shape.upper;
    solid.shape.transform.rotate = {axis, degrees};
    solid.shape.transform.translate = center;
    normal = Eigen::AngleAxisd(degrees * pi / 180, axis) * Vec3::UnitX();
  }
  // Formula for the signed distance (m) of a point beyond the middle of the plate at the start.
  std::string beyond() const {
    const Vec3& c = solid.shape.transform.translate;
    return fmt::format("(({:.17g})*(x-({:.17g}))+({:.17g})*(y-({:.17g}))+({:.17g})*(z-({:.17g})))", normal[0], c[0],
                       normal[1], c[1], normal[2], c[2]);
  }
};

// Liquid up to about half the height, on the low side of the plate only.
Scene dam(int dim, int cells, const Plate& plate) {
  Scene s = box_scene(dim, cells);
  s.gravity = {0, -9.81, 0};
  s.time.max_step = 0.01;
  add_liquid(s, fmt::format("max({}, y-0.53)", plate.beyond()));
  s.solids.push_back(plate.solid);
  return s;
}

struct Seen {
  int beyond = 0;  // wet cells whose centres lie on the far side
  double volume = 0, lost = 0, speed = 0;
};

// Number of wet cells on the far side of the plate, moved by `shift` along x.
int wet_beyond(const Simulation& sim, const Scene& s, const Plate& plate, double shift) {
  const FrameField phi = sim.frame_field("surface");
  const double h = s.domain.cell_size;
  int count = 0;
  std::size_t n = 0;
  for (int k = phi.lower[2]; k < std::max(phi.upper[2], phi.lower[2] + 1); ++k)
    for (int j = phi.lower[1]; j < phi.upper[1]; ++j)
      for (int i = phi.lower[0]; i < phi.upper[0]; ++i, ++n) {
        const Vec3 x((i + 0.5) * h, (j + 0.5) * h, s.dimension == 2 ? 0 : (k + 0.5) * h);
        const Vec3 from = x - plate.solid.shape.transform.translate - Vec3(shift, 0, 0);
        count += phi.values[n] < 0 && plate.normal.dot(from) > plate.solid.shape.upper[0];
      }
  return count;
}

template <class Shift>
Seen run(const Scene& s, const Plate& plate, int steps, const Shift& shift) {
  const auto sim = make_simulation(s, Communicator());
  const double start = sim->stats().liquid_volume;
  Seen seen;
  for (int n = 0; n < steps; ++n) {
    const StepStats stats = sim->step(sim->time() + 1);
    seen.speed = std::max(seen.speed, stats.max_speed);
    seen.beyond = std::max(seen.beyond, wet_beyond(*sim, s, plate, shift(sim->time())));
  }
  seen.volume = sim->stats().liquid_volume;
  seen.lost = 1 - seen.volume / start;
  return seen;
}

double still(double) {
  return 0;
}

}  // namespace

TEST_CASE("a plate thinner than a cell holds back the liquid on one side of it", "[long]") {
  for (int dim : {2, 3})
    for (double thickness : thicknesses)
      for (double degrees : {0.0, 17.0}) {
        const int cells = dim == 2 ? 24 : 12;
        Scene s = box_scene(dim, cells);
        const Plate plate(s, thickness, {0.52, 0.5, dim == 2 ? 0 : 0.5}, degrees);
        const Seen seen = run(dam(dim, cells, plate), plate, 100, still);
        CAPTURE(dim, thickness, degrees, seen.lost, seen.speed);
        CHECK(seen.beyond == 0);
        // Water that fell out of the tank would reach 3 m/s. The bar leaves room for sloshing from corners that the
        // grid rounds.
        CHECK(seen.speed < (degrees == 0 ? 0.1 : 0.4));
        CHECK(std::abs(seen.lost) < 0.005);
      }
}

TEST_CASE("a paddle thinner than a cell takes the liquid before it along, and leaves none behind", "[long]") {
  for (int dim : {2, 3})
    for (double thickness : thicknesses)
      for (double degrees : {0.0, 17.0}) {
        const int cells = dim == 2 ? 24 : 12;
        Scene s = box_scene(dim, cells);
        Plate plate(s, thickness, {0.52, 0.5, dim == 2 ? 0 : 0.5}, degrees);
        plate.solid.kind = SolidKind::kinematic;
        plate.solid.motion.translate[0] = "-0.1*sin(4*t)";
        const Seen seen = run(dam(dim, cells, plate), plate, 200, [](double t) { return -0.1 * std::sin(4 * t); });
        CAPTURE(dim, thickness, degrees, seen.lost, seen.speed);
        CHECK(seen.beyond == 0);
        CHECK(std::abs(seen.lost) < 0.02);
      }
}

// The sheet is half as heavy again as water: it must not fall faster than without any drag, and the water keeps its
// volume.
TEST_CASE("a rigid sheet thinner than a cell sinks in water and stays stable", "[long]") {
  for (int dim : {2, 3})
    for (double thickness : thicknesses)
      for (double degrees : {0.0, 20.0}) {
        const int cells = dim == 2 ? 32 : 16;
        Scene s = box_scene(dim, cells);
        s.gravity = {0, -9.81, 0};
        s.time.max_step = 0.01;
        add_pool(s, 0.7);
        const double h = s.domain.cell_size;
        s.solids.push_back(rigid_box("sheet", {0.4, thickness * h, dim == 2 ? 0 : 0.4}, {0.5, 0.5, dim == 2 ? 0 : 0.5},
                                     1500, degrees));
        const auto sim = make_simulation(s, Communicator());
        const double volume = sim->stats().liquid_volume;
        double fastest = 0, rise = -1;
        while (sim->time() < 1) {
          (void)sim->step(1);
          const SolidState sheet = sim->solids()[0];
          fastest = std::max(fastest, sheet.velocity.norm() + 0.2 * sheet.angular_velocity.norm());
          rise = std::max(rise, sheet.position[1] - 0.5);
        }
        const double sunk = 0.5 - sim->solids()[0].position[1], lost = 1 - sim->stats().liquid_volume / volume;
        WARN(dim << "D, " << thickness << " cells, " << degrees << " degrees: sank " << sunk << " m in 1 s, at most "
                 << fastest << " m/s, rose " << rise << " m, volume " << lost);
        CHECK(sunk > 0);
        CHECK(rise < 0.1 * h);
        CHECK(fastest < 9.81 / 3 * std::sqrt(2 * 0.5 / (9.81 / 3)) + 1);
        CHECK(std::abs(lost) < 0.02);
      }
}

// A source over the whole tank leaves no air beside a box of 0.96 cells, though all was dry before.
TEST_CASE("a source brings liquid to all sides of a solid thinner than a cell") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, 16);
    s.gravity = {0, 0, 0};
    s.time.max_step = 0.05;
    SolidSpec box = rigid_box("box", Vec3::Constant(0.06), {0.52, 0.5, dim == 2 ? 0.0 : 0.49}, 200);
    box.shape.transform.rotate = {Vec3(0, 0, 1), 20};
    s.solids.push_back(box);
    LiquidSourceSpec source;
    source.shape.kind = "expression";
    source.shape.phi = "-1";
    s.liquid.sources.push_back(source);
    const auto sim = make_simulation(s, Communicator());
    const double first = sim->step(1).liquid_volume;
    for (int n = 0; n < 2; ++n) (void)sim->step(1);
    WARN(dim << "D: " << first << " of the tank is full after a step, " << sim->stats().liquid_volume
             << " after three");
    CHECK(first == Approx(sim->stats().liquid_volume).epsilon(1e-9));  // the source is as full as it will be
  }
}

}  // namespace thin_solids_tests
