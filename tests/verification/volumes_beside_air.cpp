// Volumes in cells beside gas that flows, enclosed air, and walls that liquid separates from.
#include "volume_scenes.h"

namespace volumes_beside_air_tests {
using namespace seiche;
using test::kept_in_cells;

namespace {

double energy(const StepStats& stats) {
  return stats.kinetic_energy + stats.potential_energy;
}

// Extremes of a run whose volume of liquid keeps to rounding.
struct Run {
  std::unique_ptr<Simulation> sim;
  double spilled = 0;                    // over the liquid
  double start = 0, most = 0;            // energy, J
  double least_gas = 1e9, most_gas = 0;  // m^Dim, after the first step
};

Run run(const Scene& s, double end) {
  Run r{make_simulation(s, Communicator())};
  const double volume = r.sim->stats().liquid_volume;
  r.start = r.most = energy(r.sim->stats());
  while (r.sim->time() < end * (1 - 1e-12)) {
    const StepStats stats = r.sim->step(end);
    REQUIRE(stats.liquid_volume == Approx(volume).epsilon(1e-11));
    r.most = std::max(r.most, energy(stats));
    r.least_gas = std::min(r.least_gas, stats.gas_volume), r.most_gas = std::max(r.most_gas, stats.gas_volume);
  }
  r.spilled = r.sim->stats().volume_spilled / volume;
  CHECK(r.sim->stats().volume_corrected == 0);
  return r;
}

Scene under_gas(int dim, int cells, const Formula& phi) {
  Scene s = kept_in_cells(dim, cells, phi);
  s.gas.present = true;
  s.gas.density = 1.2;
  return s;
}

}  // namespace

TEST_CASE("liquid under gas at rest stays at rest with volumes in cells", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = under_gas(dim, 16, "y-0.53");
    s.solver.tolerance = 1e-11;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 10; ++n) (void)sim->step(1);
    CHECK(sim->stats().max_speed < 1e-9);
    CHECK(sim->stats().volume_spilled < 1e-9);
  }
}

// The surface passes cells that the ball cuts. Once rounding had moved the ball, their volumes were evened out with
// full ones: it rose at 1e-5 m/s.
TEST_CASE("a neutral ball between two fluids alike stays at rest with volumes in cells", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = under_gas(dim, 16, "y-0.47");
    s.gas.density = 1000;
    s.solver.tolerance = 1e-12;
    s.time.fixed_step = 0.01;
    SolidSpec ball;
    ball.name = "ball";
    ball.kind = SolidKind::rigid;
    ball.shape.where = "test";
    ball.shape.kind = "sphere";
    ball.shape.center = {0.5, 0.5, dim == 3 ? 0.5 : 0.0};
    ball.shape.radius = 0.2;
    ball.rigid.density = 1000;
    s.solids.push_back(ball);
    const auto sim = make_simulation(s, Communicator());
    double fastest = 0;
    for (int n = 0; n < 30; ++n) fastest = std::max(fastest, sim->step(1).max_speed);
    CHECK(fastest <= 1e-11);  // 1.0e-13: ten times the tolerance, a step
  }
}

// The shift of the level set moves 2 % of the liquid in 2D, and energy rises by 1.4 %.
TEST_CASE("a dam break into gas keeps its volume to rounding and gains no energy", "[volumes]") {
  for (const int dim : {2, 3}) {
    const Formula phi = dim == 2 ? "max(x-0.4,y-0.5)" : "max(x-0.4,max(y-0.5,z-0.6))";
    const Run r = run(under_gas(dim, dim == 2 ? 48 : 16, phi), 0.8);
    WARN(dim << "D: spilled " << r.spilled << ", most energy " << r.most / r.start - 1 << " above the start");
    CHECK(r.spilled < (dim == 2 ? 0.01 : 0.05));  // 0.12, 2.5 %; in 3D few cells, which jets fill in part
    CHECK(r.most < r.start * (1 + 1e-3));
  }
}

// A bubble that rises through a closed box: all other air is one region under the lid.
TEST_CASE("enclosed air keeps its volume beside volumes in cells", "[volumes]") {
  for (const int dim : {2, 3}) {
    const Formula bubble = dim == 2 ? "0.2-sqrt((x-0.5)^2+(y-0.35)^2)" : "0.25-sqrt((x-0.5)^2+(y-0.35)^2+(z-0.5)^2)";
    Scene s = kept_in_cells(dim, dim == 2 ? 40 : 20, "max(y-0.85," + bubble + ")");
    s.gas.present = true;
    s.gas.bubbles = Bubbles::volume_conserving;
    const Run r = run(s, 0.3);
    WARN(dim << "D: spilled " << r.spilled << ", air from " << r.least_gas << " to " << r.most_gas);
    CHECK(r.spilled < 0.01);                              // 1e-4, 3e-4
    CHECK(r.most_gas - r.least_gas < 1e-3 * r.most_gas);  // 1.3e-4, 1e-4: what is off flows out in ten steps
    CHECK(r.most < r.start * (1 + 0.01));  // 0.6, 0.9 %; the shift's 0.5 %: its first step is of first order
  }
}

// Gravity throws the liquid on the floor to the lid. By the shift, 20 % of it were moved by the end.
TEST_CASE("liquid that leaves walls keeps its volume in cells", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 32 : 16, "max(x-0.5,y-0.6)");
    s.gravity = {6, 9.81, 0};
    s.liquid.separates = true;
    const Run r = run(s, 0.6);
    WARN(dim << "D: spilled " << r.spilled);
    CHECK(r.spilled < 0.02);  // 0.23, 0.01 %
    CHECK(r.most < r.start + 0.01 * std::abs(r.start));
  }
}

}  // namespace volumes_beside_air_tests
