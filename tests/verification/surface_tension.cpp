// Surface tension against Laplace, Rayleigh and Young: drops at rest, oscillating and sessile.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "fluid/pressure/pressure.h"
#include "grid/loops.h"
#include "levelset/redistance.h"
#include "scenes.h"

namespace surface_tension_tests {
using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

// A drop in vacuum, rho = sigma = 1.
Scene drop_scene(int dimension, int cells, double size, const Formula& phi, double viscosity) {
  Scene s = test::box_scene(dimension, cells, size);
  s.liquid.density = 1;
  s.liquid.surface_tension = 1;
  s.liquid.viscosity = fmt::format("{:.17g}", viscosity);
  test::add_liquid(s, phi);
  return s;
}

void add_probe(Scene& s, ProbeKind kind, Vec3 position) {
  ProbeSpec probe;
  probe.name = fmt::format("p{}", s.probes.size());
  probe.kind = kind;
  probe.position = position;
  s.probes.push_back(probe);
}

// Largest speed, times sqrt(rho D/sigma), after a step of 1 ms of a drop with a uniform pressure jump.
template <int Dim>
double unbalanced(int n) {
  Geometry<Dim> g;
  g.h = 1.0 / n;
  g.cells = IVec<Dim>::Constant(n);
  const Communicator ranks(MPI_COMM_SELF);
  const Layout<Dim> layout(g, g.box(), 4);
  const Halo<Dim> halo(layout, {g.box()}, ranks);
  CellField<Dim> phi(layout);
  const Vec<Dim> c = Vec<Dim>::LinSpaced(0.503, 0.517);
  for_each_index(layout, layout.cells(), [&](Site s, const IVec<Dim>& i) {
    phi[s] = (layout.position(i, cell_offset<Dim>()) - c).norm() - 0.4;
  });
  fill_level_set_ghosts(layout, halo, phi);
  const FaceGeometry<Dim> faces(layout);
  const FaceField<Dim> jump(layout, (Dim - 1) / 0.4), rest(layout);
  ProjectionInput<Dim> in{layout, halo, ranks, phi, faces, 1.0, 1e-3};
  in.surface_jump = &jump;
  const PressureRows<Dim> rows = number_rows(in);
  std::vector<double> x(rows.cells.size());
  const SolveReport report =
      solve_spd(assemble_pressure_matrix(in, rows), row_grid(in, rows), find_closed_components(in, rows),
                pressure_right_side(in, rows, rest), x, {.tolerance = 1e-15, .max_iterations = 60}, ranks);
  CAPTURE(report.residual);
  CellField<Dim> p(layout);
  for (std::size_t k = 0; k < x.size(); ++k) p[rows.cells[k]] = x[k];
  double largest = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.cells(), [&](Site f, const IVec<Dim>&) {
      largest = std::max(largest, std::abs(in.dt * face_pressure_slope(in, rows, p, a, f)));
    });
  return largest * std::sqrt(0.8);
}

}  // namespace

TEST_CASE("exact curvature is balanced exactly") {
  const double flat = unbalanced<2>(32), solid = unbalanced<3>(16);
  WARN("largest speed sqrt(rho D/sigma) after a step: 2D " << flat << ", 3D " << solid);
  CHECK(flat <= 1e-12);
  CHECK(solid <= 1e-12);
}

TEST_CASE("a drop at rest comes to rest at La = 12000, and its energy does not grow", "[long]") {
  const double mu = std::sqrt(0.8 / 12000);
  Scene s = drop_scene(2, 32, 1, "sqrt((x-0.503)^2+(y-0.494)^2)-0.4", mu);
  const auto sim = make_simulation(s, Communicator());
  // The initial shape is not quite a discrete equilibrium; the oscillation dies away. The kinetic energy of each half
  // second must not exceed that of the one before.
  double before = 1, speed = 0;
  for (int n = 1; n <= 10; ++n) {
    double most = 0;
    speed = 0;
    while (sim->time() < 0.5 * n - 1e-9) {
      const StepStats row = sim->step(0.5 * n);
      most = std::max(most, row.kinetic_energy), speed = std::max(speed, row.max_speed);
    }
    WARN("until " << 0.5 * n << " s: capillary number " << mu * speed << ", kinetic energy " << most);
    CHECK(most <= 1.05 * before);  // margin for a beat of the remaining modes
    before = most;
  }
  CHECK(mu * speed <= 1e-6);
}

TEST_CASE("the pressure in a drop is sigma kappa") {
  for (int dim : {2, 3}) {
    Scene s =
        drop_scene(dim, dim == 2 ? 32 : 20, 1,
                   dim == 2 ? "sqrt((x-0.503)^2+(y-0.494)^2)-0.4" : "sqrt((x-0.503)^2+(y-0.494)^2+(z-0.51)^2)-0.4", 0);
    add_probe(s, ProbeKind::pressure, {0.503, 0.494, dim == 3 ? 0.51 : 0.0});
    for (const double density : {1.0, 1000.0}) {
      s.liquid.density = density;
      const auto sim = make_simulation(s, Communicator());
      for (int n = 0; n < 5; ++n) sim->step(1);
      const double expected = (dim - 1) / 0.4, error = std::abs(sim->probe(0).value / expected - 1);
      WARN(dim << "D, density " << density << ": pressure " << sim->probe(0).value << " Pa, off by " << error);
      CHECK(error <= 0.005);
    }
  }
}

TEST_CASE("a sessile drop settles to the circle of its contact angle", "[long]") {
  for (const double degrees : {60.0, 90.0, 120.0}) {
    // A half disc of radius 0.25 on the floor.
    Scene s = drop_scene(2, 48, 1.2, "sqrt((x-0.6)^2+y^2)-0.25", 0.15);
    s.liquid.contact_angle = degrees;
    add_probe(s, ProbeKind::surface_height, {0.6, 0.01, 0});
    add_probe(s, ProbeKind::front, {0, 0, 0});
    const auto sim = make_simulation(s, Communicator());
    while (sim->time() < 1.5) sim->step(1.5);
    const double theta = degrees * pi / 180, area = pi * 0.25 * 0.25 / 2;
    const double radius = std::sqrt(area / (theta - std::sin(theta) * std::cos(theta)));
    const double height = radius * (1 - std::cos(theta));
    const double above = radius * std::cos(theta) + 0.0125;  // of the floor's cell centres over the circle's centre
    const double reach = std::sqrt(radius * radius - above * above);
    const double high = sim->probe(0).value / height - 1, wide = (sim->probe(1).value - 0.6) / reach - 1;
    WARN(degrees << " degrees: height off by " << high << ", half width by " << wide << ", speed "
                 << sim->stats().max_speed);
    CHECK(std::abs(high) <= 0.02);
    CHECK(std::abs(wide) <= 0.02);
  }
}

namespace {

// A drop of viscosity 0.002 oscillates in mode 2 for four periods, in steps of `factor` times the explicit limit.
struct Swing {
  double period_error, amplitude;  // relative; largest in the later half, over the radius
};

Swing swing(double factor) {
  const double radius = 0.3, omega = std::sqrt(6 / std::pow(radius, 3)), end = 4 * 2 * pi / omega;
  Scene s = drop_scene(2, 32, 1, "sqrt((x-0.5)^2+(y-0.5)^2)-0.3*(1+0.05*cos(2*atan2(y-0.5,x-0.5)))", 0.002);
  s.liquid.tension_scheme = TensionScheme::semi_implicit;
  s.time.max_step = factor * std::sqrt(std::pow(1.0 / 32, 3) / (4 * pi));
  add_probe(s, ProbeKind::surface_height, {0.5, 0.5, 0});
  const auto sim = make_simulation(s, Communicator());
  const double level = 0.5 + radius * (1 - 0.05 * 0.05 / 4);
  double largest = 0, before = sim->probe(0).value - level, t = 0;
  std::vector<double> crossings;
  while (sim->time() < end * (1 - 1e-12)) {
    sim->step(end);
    const double now = sim->probe(0).value - level;
    if ((before < 0) != (now < 0)) crossings.push_back(t + (sim->time() - t) * before / (before - now));
    before = now;
    t = sim->time();
    if (t > end / 2) largest = std::max(largest, std::abs(now) / radius);
  }
  if (crossings.size() < 5) return {1, largest};
  const double period = 2 * (crossings.back() - crossings.front()) / double(crossings.size() - 1);
  return {period * omega / (2 * pi) - 1, largest};
}

}  // namespace

TEST_CASE("semi-implicit tension bears steps ten times as long", "[long]") {
  // Measured: 0.5 %, 2.2 % and 5.9 %. Ten times the explicit step is 1/27 of a period.
  const std::array<std::pair<double, double>, 3> bars{{{3, 0.01}, {5, 0.03}, {10, 0.07}}};
  for (const auto& [factor, bar] : bars) {
    const Swing found = swing(factor);
    WARN("steps " << factor << " times as long: period off by " << found.period_error << ", amplitude later "
                  << found.amplitude);
    CHECK(std::abs(found.period_error) <= bar);
    CHECK(found.amplitude < 0.05);
  }
}

TEST_CASE("a square of liquid rounds off", "[long]") {
  Scene s = drop_scene(2, 32, 1, "max(abs(x-0.5),abs(y-0.5))-0.25", 0.1);
  add_probe(s, ProbeKind::surface_height, {0.5, 0.5, 0});
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 2) sim->step(2);
  const double radius = 0.5 / std::sqrt(pi);
  WARN("radius " << sim->probe(0).value - 0.5 << " of " << radius << ", speed " << sim->stats().max_speed);
  CHECK(sim->probe(0).value - 0.5 == Approx(radius).epsilon(5e-3));
}

}  // namespace surface_tension_tests
