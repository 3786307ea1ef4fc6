// Pressure probes on solids read the liquid on the solid's side where they lie.
#include <catch2/catch.hpp>

#include "scenes.h"

namespace probes_on_solids_tests {
using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

ProbeSpec pressure_probe(const std::string& name, const Vec3& x) {
  ProbeSpec probe;
  probe.name = name;
  probe.kind = ProbeKind::pressure;
  probe.position = x;
  return probe;
}

// A gate of some thickness, turned by `degrees` about the middle of the box, between water that stands at 0.75 and 0.5
// m, g = 10 m/s^2. Probes on both faces of the gate, at 0.25 m.
template <int Dim>
void check_gate(double cells_thick, double degrees) {
  const double h = 1.0 / 24, half = 0.5 * cells_thick * h, turn = degrees * pi / 180, middle = 0.5 + 0.007;
  Scene s = test::box_scene(Dim, 24);
  if (Dim == 3) s.domain.cells[2] = 6, s.domain.upper[2] = 0.25;
  s.gravity = {0, -10, 0};
  s.time.end = 0.05;
  const std::string across = fmt::format("((x-{})*{}+(y-0.5)*{})", middle, std::cos(turn), std::sin(turn));
  test::add_liquid(s, fmt::format("max(y-0.75,{})", across));
  test::add_liquid(s, fmt::format("max(y-0.5,-{})", across));
  SolidSpec gate;
  gate.name = "gate";
  gate.shape.kind = "box";
  gate.shape.lower = {-half, -2, -2}, gate.shape.upper = {half, 2, 2};
  gate.shape.transform.rotate.degrees = degrees;
  gate.shape.transform.translate = {middle, 0.5, 0};
  s.solids.push_back(gate);
  const double z = Dim == 3 ? 0.1 : 0;
  const auto on_face = [&](int side) {
    return Vec3(middle + (side * half + 0.25 * std::sin(turn)) / std::cos(turn), 0.25, z);
  };
  s.probes = {pressure_probe("high", on_face(-1)), pressure_probe("low", on_face(1))};
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < s.time.end - 1e-9) (void)sim->step(s.time.end);
  INFO(Dim << "D, " << cells_thick << " cells, " << degrees << " degrees");
  // Thin gates close whole faces. A slanted gate cuts cells, and surfaces beside it err by 0.1 cells.
  const double tolerance = degrees != 0 ? 0.02 : cells_thick < 1 ? 5e-3 : 1e-3;
  CHECK(sim->probe(0).value == Approx(5000).epsilon(tolerance));
  CHECK(sim->probe(1).value == Approx(2500).epsilon(tolerance));
}

}  // namespace

TEST_CASE("probes on solids: a gate between two levels") {
  for (const double thick : {0.4, 1.4, 2.4, 5.0})
    for (const double degrees : {0.0, 20.0}) {
      check_gate<2>(thick, degrees);
      check_gate<3>(thick, degrees);
    }
}

// The liquid's pressure and velocity are continued into solids, where they mean nothing.
TEST_CASE("probes on solids: nothing is measured inside") {
  const int dim = GENERATE(2, 3);
  Scene s = test::box_scene(dim, 16);
  s.gravity = {0, -10, 0};
  s.time.end = 0.01;
  test::add_liquid(s, "y-0.8");
  const double z = dim == 3 ? 1 : 0;
  SolidSpec block;
  block.name = "block";
  block.shape.kind = "box";
  block.shape.lower = {0.3, 0.3, 0.3 * z}, block.shape.upper = {0.7, 0.7, 0.7 * z};
  s.solids.push_back(block);
  s.probes = {pressure_probe("inside", {0.5, 0.5, 0.5 * z}), pressure_probe("velocity inside", {0.5, 0.5, 0.5 * z}),
              pressure_probe("on the face", {0.3, 0.5, 0.5 * z})};
  s.probes[1].kind = ProbeKind::velocity;
  const auto sim = make_simulation(s, Communicator());
  (void)sim->step(s.time.end);
  CAPTURE(dim);
  CHECK(!sim->probe(0).defined);
  CHECK(!sim->probe(1).defined);
  CHECK(sim->probe(2).defined);
}

}  // namespace probes_on_solids_tests
