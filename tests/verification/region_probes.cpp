// Probes over regions: flux, volume, loads of groups of solids; arrays of points.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/solid_spec.h"
#include "volume_scenes.h"

namespace region_probes_tests {
using namespace seiche;
using test::add_liquid;
using test::box_scene;

namespace {

ProbeSpec box_probe(ProbeKind kind, const std::string& name, const Vec3& lower, const Vec3& upper) {
  ProbeSpec probe;
  probe.kind = kind, probe.name = name;
  probe.lower = lower, probe.upper = upper;
  return probe;
}

double depth(int dim) {
  return dim == 2 ? 0 : 1;
}

}  // namespace

TEST_CASE("volume probes: boxes that tile the domain sum to the liquid's volume", "[probes]") {
  for (const int dim : {2, 3})
    for (const bool cells : {false, true}) {
      Scene s = box_scene(dim, dim == 2 ? 32 : 12);
      s.gravity = {0, -9.81, 0};
      s.liquid.volume = cells ? VolumeKeeping::in_cells : VolumeKeeping::by_shift;
      add_liquid(s, "y-0.42-0.2*x");
      const double x = 0.371, y = 0.493;  // cuts cells
      s.probes = {box_probe(ProbeKind::volume, "a", {0, 0, 0}, {x, y, depth(dim)}),
                  box_probe(ProbeKind::volume, "b", {x, 0, 0}, {1, y, depth(dim)}),
                  box_probe(ProbeKind::volume, "c", {0, y, 0}, {1, 1, depth(dim)}),
                  box_probe(ProbeKind::volume, "all", {0, 0, 0}, {1, 1, depth(dim)})};
      const auto sim = make_simulation(s, Communicator());
      CHECK(sim->probe(0).value == Approx(x * (0.42 + 0.1 * x)).epsilon(0.01));  // places within cells, by points
      for (int n = 0; n < 3; ++n) (void)sim->step(1);
      const double volume = sim->stats().liquid_volume;
      CHECK(sim->probe(3).value == Approx(volume).epsilon(1e-13));  // a sum of the same shares
      CHECK(sim->probe(0).value + sim->probe(1).value + sim->probe(2).value == Approx(volume).epsilon(1e-9));
    }
}

// A full channel: u A through each cross section, also between planes of faces; half of it through half of it.
TEST_CASE("flux probes: a channel carries u A, with its sign", "[probes]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, dim == 2 ? 16 : 8);
    add_liquid(s, "-1");
    s.domain.sides[0][0] = {SideType::inflow, {"0.5", "0", "0"}, "0"};
    s.domain.sides[0][1] = {SideType::outflow, {"0", "0", "0"}, "0"};
    s.probes = {box_probe(ProbeKind::flux, "face", {0.5, 0, 0}, {0.5, 1, depth(dim)}),
                box_probe(ProbeKind::flux, "between", {0.53, 0, 0}, {0.53, 1, depth(dim)}),
                box_probe(ProbeKind::flux, "part", {0.5, 0.2, 0}, {0.5, 0.63, depth(dim)}),
                box_probe(ProbeKind::flux, "across", {0.2, 0.5, 0}, {0.9, 0.5, depth(dim)}),
                box_probe(ProbeKind::flux, "end", {1, 0, 0}, {1, 1, depth(dim)})};
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 3; ++n) (void)sim->step(1);
    const double tolerance = 1e-6;  // that of the solver, 1e-8, over the cells
    CHECK(sim->probe(0).value == Approx(0.5).epsilon(tolerance));
    CHECK(sim->probe(1).value == Approx(0.5).epsilon(tolerance));
    CHECK(sim->probe(2).value == Approx(0.5 * 0.43).epsilon(tolerance));
    CHECK(sim->probe(3).value == Approx(0).margin(tolerance));
    CHECK(sim->probe(4).value == Approx(0.5).epsilon(tolerance));
  }
}

// A falling column: what the flux has carried through a plane is what the volume behind it lost.
TEST_CASE("flux and volume probes agree in a dam break", "[probes]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, dim == 2 ? 48 : 16);
    s.gravity = {0, -9.81, 0};
    add_liquid(s, "max(x-0.4, y-0.7)");
    s.probes = {box_probe(ProbeKind::flux, "flux", {0.4, 0, 0}, {0.4, 1, depth(dim)}),
                box_probe(ProbeKind::volume, "behind", {0, 0, 0}, {0.4, 1, depth(dim)})};
    s.time.fixed_step = 0.002;
    const auto sim = make_simulation(s, Communicator());
    const double start = sim->probe(1).value;
    double carried = 0, flux = sim->probe(0).value;
    while (sim->time() < 0.2 - 1e-9) {
      (void)sim->step(0.2);
      carried += 0.5 * 0.002 * (flux + sim->probe(0).value);
      flux = sim->probe(0).value;
    }
    const double lost = start - sim->probe(1).value;
    WARN(dim << "D: lost " << lost << ", carried " << carried);
    CHECK(lost > 0.05);
    CHECK(carried == Approx(lost).epsilon(dim == 2 ? 0.02 : 0.05));  // the wet part of faces, to a fifth of a cell
  }
}

TEST_CASE("force and torque probes sum the rows of solids.csv", "[probes]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, dim == 2 ? 24 : 12);
    s.gravity = {0, -9.81, 0};
    add_liquid(s, "y-0.8");
    for (int n = 0; n < 3; ++n) {
      SolidSpec& post = s.solids.emplace_back();
      post.name = n < 2 ? "post-" + std::to_string(n + 1) : "gate";
      post.kind = SolidKind::fixed;
      post.shape.kind = "sphere", post.shape.where = "test";
      post.shape.center = {0.2 + 0.3 * n, 0.3 + 0.1 * n, dim == 2 ? 0 : 0.5}, post.shape.radius = 0.11;
    }
    ProbeSpec force, torque;
    force.kind = ProbeKind::force, force.name = "f", force.solids = {"post*", "post-1"};
    torque.kind = ProbeKind::torque, torque.name = "t", torque.solids = {"*"}, torque.about = {0.1, 0.2, 0};
    s.probes = {force, torque};
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 2; ++n) (void)sim->step(1);
    Vec3 of_posts = Vec3::Zero(), of_all = Vec3::Zero();
    for (const SolidState& solid : sim->solids()) {
      if (solid.name != "gate") of_posts += solid.force;
      of_all += solid.torque + (solid.position - torque.about).cross(solid.force);
    }
    CHECK(of_posts.norm() > 50);
    CHECK(sim->probe(0).is_vector);
    CHECK((sim->probe(0).vector - of_posts).norm() <= 1e-15 * of_posts.norm());
    CHECK((sim->probe(1).vector - of_all).norm() <= 1e-15 * of_all.norm());
  }
}

}  // namespace region_probes_tests
