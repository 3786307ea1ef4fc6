// Bodies far lighter than the liquid, at any stiffness, in liquid without a free surface.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "elastic_scenes.h"

namespace elastic_extremes_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double g = 9.81;  // m/s^2

// A full channel with four walls and two vortices of up to 1 m/s.
Scene full_channel() {
  Scene s = box_scene(2, 48);
  s.domain.cells[1] = 24;
  s.domain.upper[1] = 0.5;
  s.gravity = {0, -g, 0};
  add_liquid(s, "-1");
  s.liquid.velocity = {"sin(6.2831853*x)*cos(6.2831853*y)", "-cos(6.2831853*x)*sin(6.2831853*y)", "0"};
  s.time.cfl = 2;
  return s;
}

SolidSpec flap(const Stiffness& stiffness) {
  SolidSpec s = elastic_box("flap", {0.48, 0, 0}, {0.53, 0.3, 0}, 10, stiffness, 0.025);
  pin(s, {0.4, -0.1, 0}, {0.6, 0, 0});
  return s;
}

SolidSpec sheet(const Stiffness& stiffness) {
  SolidSpec s = elastic_box("sheet", {0.25, 0.243, 0}, {0.65, 0.257, 0}, 1, stiffness, 0.02);
  pin(s, {0.2, 0.2, 0}, {0.25, 0.3, 0});
  return s;
}

struct Outcome {
  double fastest = 0, fastest_body = 0, divergence = 0;
  double energy = 0;  // largest sum of kinetic, elastic and lift energy, relative to the initial energy
  int rejected = 0;
  std::int64_t steps = 0;
};

// Potential energy g (m y_m - rho integral of y over the body): the light body rises and liquid sinks in its place.
double lift(const Scene& s, const Simulation& sim, double mass) {
  const SurfaceMesh surface = sim.solid_surface(0);
  double moment = 0;
  for (const auto& [a, b] : surface.segments) {
    const Vec3 &p = surface.points[std::size_t(a)], &q = surface.points[std::size_t(b)];
    moment -= (q[0] - p[0]) * (p[1] * p[1] + p[1] * q[1] + q[1] * q[1]) / 6;
  }
  return g * (mass * sim.solids()[0].position[1] - s.liquid.density * moment);
}

// Advances from frame to frame, as runs do: planned steps end at frames, and shortened steps stretch rotating bodies
// (docs/elastic.md, Limits).
Outcome run(Scene s, const SolidSpec& solid, double end) {
  s.solids.push_back(solid);
  s.time.end = end;
  const auto sim = make_simulation(s, Communicator());
  Outcome o;
  const Vec3 size = solid.shape.upper - solid.shape.lower;
  const double mass = solid.rigid.density * size[0] * size[1];
  const double start = sim->stats().kinetic_energy, lift_at_start = lift(s, *sim, mass);
  while (sim->time() < end) {
    const double frame = (std::floor(sim->time() * s.time.frame_rate * (1 + 1e-12) + 1e-9) + 1) / s.time.frame_rate;
    const StepStats step = sim->step(std::min(frame, end));
    o.fastest = std::max(o.fastest, step.max_speed);
    o.divergence = std::max(o.divergence, step.max_divergence);
    o.rejected += step.rejected;
    const double lifted = lift(s, *sim, mass) - lift_at_start;
    o.energy = std::max(o.energy, (step.kinetic_energy + step.elastic_energy + lifted) / start);
    for (const Vec3& v : sim->solid_volume(0).velocity) o.fastest_body = std::max(o.fastest_body, v.norm());
  }
  o.steps = sim->step_count();
  return o;
}

void check(const std::string& name, const Scene& scene, const SolidSpec& solid, double end) {
  const Outcome o = run(scene, solid, end);
  WARN(name << ", E " << solid.elastic.youngs_modulus << ", nu " << solid.elastic.poisson_ratio << ", "
            << scene.time.frame_rate << " frames a second, " << end << " s: " << o.steps << " steps, " << o.rejected
            << " rejected; liquid at most " << o.fastest << ", body " << o.fastest_body << " m/s, energy " << o.energy
            << " of the start's");
  // The flow starts with 1 m/s; around the tip of a stiff sheet it is about sqrt(length/cell) = 4.4 times as fast. Only
  // the body's weight adds energy. Any further gain, up to 0.09 for soft solids, is an error of the scheme.
  CHECK(o.fastest <= 5);
  CHECK(o.energy <= 1.1);
}

// Both extremes of stiffness and, nearly incompressible, one in between, for 0.3 s at 24 frames a second. For the flap
// at E = 1e4, nu 0.499, and at 1e6 and 1e10, nu 0.4, the energy is 1.01 at most (docs/elastic.md).
void check(const std::string& name, SolidSpec (*make)(const Stiffness&)) {
  for (const Stiffness& stiffness : {Stiffness{1e2, 0.4}, {1e8, 0.499}, {1e12, 0.499}})
    check(name, full_channel(), make(stiffness), 0.3);
}

}  // namespace

TEST_CASE("a flap of density ratio 0.01 in a full channel moves at bounded speeds at any stiffness",
          "[elastic][long]") {
  check("flap", flap);
}

TEST_CASE("a sheet of density ratio 1e-3 in a full channel moves at bounded speeds at any stiffness", "[elastic]") {
  check("sheet", sheet);
}

// The sheet is rolled up by then. `seiche run` of this scene to 1 s with 2, 10, 24 and 100 frames a second and E = 1e2,
// 1e4, 1e8, 1e12 Pa: the energy never exceeds the initial one, the liquid reaches 3.7 m/s at most.
TEST_CASE("a sheet of density ratio 1e-3 as soft as to roll up moves at bounded speeds", "[elastic][long]") {
  Scene s = full_channel();
  s.time.frame_rate = 10;
  check("sheet", s, sheet({1e2, 0.4}), 0.7);
}

}  // namespace elastic_extremes_tests
