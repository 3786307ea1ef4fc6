// Liquid sealed in cavities of elastic bodies: however they are squeezed, it keeps its volume.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "elastic_scenes.h"

using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double inner = 0.2, outer = 0.3;

// A ring, or a hollow ball, full of liquid; two plates come from both sides at `speed`.
Scene squeezed_bag(int dim, int cells, double speed, double end) {
  Scene s = box_scene(dim, cells);
  s.gravity = {0, -9.81, 0};
  const std::string z = dim == 2 ? "" : "+(z-0.5)^2";
  add_liquid(s, fmt::format("sqrt((x-0.5)^2+(y-0.5)^2{})-0.25", z));
  SolidSpec bag = elastic_solid("bag", 1100, {1e5, 0.4}, dim == 2 ? 0.05 : 0.1);
  if (dim == 3) bag.elastic.element_order = 1;  // a tenth of the time
  bag.shape.kind = "expression";
  bag.shape.phi = fmt::format("abs(sqrt((x-0.5)^2+(y-0.5)^2{})-{})-{}", z, (inner + outer) / 2, (outer - inner) / 2);
  s.solids.push_back(bag);
  for (const int side : {0, 1}) {
    SolidSpec plate;
    plate.name = side == 0 ? "low" : "high";
    plate.kind = SolidKind::kinematic;
    plate.shape.where = "test";
    plate.shape.kind = "box";
    const double lower = side == 0 ? 0.08 : 0.82;
    plate.shape.lower = {0.1, lower, 0.1};
    plate.shape.upper = {0.9, lower + 0.1, 0.9};
    plate.motion.translate = {"0", fmt::format("{}*t", side == 0 ? speed : -speed), "0"};
    s.solids.push_back(plate);
  }
  s.time.end = end;
  s.time.max_step = 4e-3;
  return s;
}

// Signed volume between a facet and the middle of the domain: at rest negative where the facet is on the cavity's wall.
template <std::size_t N>
double cone(const SurfaceMesh& surface, const std::array<int, N>& f) {
  const auto p = [&](std::size_t i) { return Vec3(surface.points[std::size_t(f[i])] - Vec3(0.5, 0.5, 0.5)); };
  if constexpr (N == 2)
    return 0.5 * (p(0)[0] * p(1)[1] - p(0)[1] * p(1)[0]);
  else
    return p(0).dot(p(1).cross(p(2))) / 6;
}

// Volume within the facets that are on the cavity's wall at rest.
double cavity_volume(const SurfaceMesh& at_rest, const SurfaceMesh& now) {
  double sum = 0;
  for (const auto& f : now.segments)
    if (cone(at_rest, f) < 0) sum -= cone(now, f);
  for (const auto& f : now.triangles)
    if (cone(at_rest, f) < 0) sum -= cone(now, f);
  return sum;
}

struct Outcome {
  double worst = 0, worst_step = 0, divergence = 0, pressed = 0;
  int first_newton = 0, last_newton = 0;
  std::int64_t steps = 0;
};

Outcome squeeze(const Scene& s) {
  const auto sim = make_simulation(s, Communicator());
  const SurfaceMesh at_rest = sim->solid_surface(0);
  const double start = cavity_volume(at_rest, at_rest);
  double last = start;
  Outcome o;
  while (sim->time() < s.time.end) {
    const StepStats step = sim->step(s.time.end);
    const double now = cavity_volume(at_rest, sim->solid_surface(0));
    o.worst = std::max(o.worst, std::abs(now / start - 1));
    o.worst_step = std::max(o.worst_step, std::abs(now - last) / start);
    o.divergence = std::max(o.divergence, step.max_divergence);
    (sim->time() < s.time.end / 2 ? o.first_newton : o.last_newton) += step.newton_iterations;
    REQUIRE(std::isfinite(step.kinetic_energy));
    last = now;
    if (getenv("SHOW"))
      fmt::print("{} {:.5f} {:.2e} vol {:.3e} newton {} it {} speed {:.3f} div {:.1e} el {:.4f} rej {}\n", step.step,
                 step.time, step.dt, now / start - 1, step.newton_iterations, step.solver_iterations, step.max_speed,
                 step.max_divergence, step.elastic_energy, step.rejected);
  }
  o.steps = sim->step_count();
  o.pressed = sim->stats().elastic_energy;
  return o;
}

}  // namespace

TEST_CASE("a ring full of liquid keeps what it holds while plates squeeze it", "[elastic][sealed]") {
  const Outcome o = squeeze(squeezed_bag(2, 40, 0.15, 0.5));
  WARN(o.steps << " steps: volume off by " << o.worst << ", in a step " << o.worst_step << "; divergence "
               << o.divergence << ", elastic energy " << o.pressed << " J, Newton " << o.first_newton << " and "
               << o.last_newton);
  CHECK(o.steps >= 100);
  CHECK(o.worst <= 1e-8);
}

TEST_CASE("a hollow ball full of liquid keeps what it holds while plates squeeze it", "[elastic][sealed]") {
  const Outcome o = squeeze(squeezed_bag(3, 20, 0.15, 0.5));
  WARN(o.steps << " steps: volume off by " << o.worst << ", in a step " << o.worst_step << "; divergence "
               << o.divergence << ", elastic energy " << o.pressed << " J, Newton " << o.first_newton << " and "
               << o.last_newton);
  CHECK(o.worst <= 1e-8);
}
