// Surface tension against Laplace, Rayleigh and Young: drops at rest, swinging and sitting.
#include <catch2/catch.hpp>

#include "fluid/pressure.h"
#include "grid/loops.h"
#include "levelset/redistance.h"
#include "scenes.h"

using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

// A drop in nothing: rho = sigma = 1.
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

// The largest speed after `from`, until `until`.
double largest_speed(Simulation& sim, double from, double until) {
  double largest = 0;
  while (sim.time() < until * (1 - 1e-12)) {
    const StepStats row = sim.step(until);
    if (row.time >= from) largest = std::max(largest, row.max_speed);
  }
  return largest;
}

// |grad p|/rho that is left beside a jump that is the same everywhere, times sqrt(rho D^3/sigma)/sqrt(D) D.
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

TEST_CASE("a drop at rest comes to rest at La = 12000, and its energy does not grow") {
  const double mu = std::sqrt(0.8 / 12000);
  Scene s = drop_scene(2, 32, 1, "sqrt((x-0.503)^2+(y-0.494)^2)-0.4", mu);
  const auto sim = make_simulation(s, Communicator());
  for (const double until : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    const double speed = largest_speed(*sim, sim->time() + 0.05, until);
    WARN("until " << until << " s: capillary number " << mu * speed << ", kinetic energy "
                  << sim->stats().kinetic_energy);
  }
  const double speed = largest_speed(*sim, 1, 1.2);
  CHECK(mu * speed <= 1e-6);
}

TEST_CASE("the pressure in a drop is sigma kappa") {
  for (int dim : {2, 3}) {
    Scene s = drop_scene(dim, dim == 2 ? 32 : 20, 1,
                         dim == 2 ? "sqrt((x-0.503)^2+(y-0.494)^2)-0.4" : "sqrt((x-0.503)^2+(y-0.494)^2+(z-0.51)^2)-0.4",
                         0);
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

TEST_CASE("a sessile drop settles to the circle of its contact angle") {
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
    const double above = radius * std::cos(theta) + 0.0125;  // of the floor's cells over the circle's centre
    const double reach = std::sqrt(radius * radius - above * above);
    const double high = sim->probe(0).value / height - 1, wide = (sim->probe(1).value - 0.6) / reach - 1;
    WARN(degrees << " degrees: height off by " << high << ", half width by " << wide << ", speed "
                 << sim->stats().max_speed);
    CHECK(std::abs(high) <= 0.02);
    CHECK(std::abs(wide) <= 0.02);
  }
}

TEST_CASE("semi-implicit tension swings on in steps ten times as long") {
  const Formula phi = "sqrt((x-0.5)^2+(y-0.5)^2)-0.3*(1+0.05*cos(2*atan2(y-0.5,x-0.5)))";
  Scene s = drop_scene(2, 32, 1, phi, 0.002);
  s.liquid.tension_scheme = TensionScheme::semi_implicit;
  add_probe(s, ProbeKind::surface_height, {0.5, 0.5, 0});
  const double explicit_step = std::sqrt(std::pow(1.0 / 32, 3) / (4 * pi));
  s.time.max_step = 10 * explicit_step;
  const auto sim = make_simulation(s, Communicator());
  const double omega = std::sqrt(6 / std::pow(0.3, 3)), end = 4 * 2 * pi / omega;
  double largest = 0, before = sim->probe(0).value - 0.8, t = 0;
  std::vector<double> crossings;
  while (sim->time() < end) {
    sim->step(end);
    const double now = sim->probe(0).value - 0.8;
    if ((before < 0) != (now < 0)) crossings.push_back(t + (sim->time() - t) * before / (before - now));
    before = now;
    t = sim->time();
    if (t > end / 2) largest = std::max(largest, std::abs(now));
  }
  REQUIRE(crossings.size() >= 5);
  const double period = 2 * (crossings.back() - crossings.front()) / double(crossings.size() - 1);
  WARN("steps " << 10 * explicit_step << " s, " << sim->step_count() << " of them: period off by "
                << period * omega / (2 * pi) - 1 << ", amplitude later " << largest / 0.3);
  CHECK(largest < 0.05 * 0.3);
  CHECK(period * omega / (2 * pi) == Approx(1).epsilon(0.05));
}

TEST_CASE("a square of liquid rounds off") {
  Scene s = drop_scene(2, 32, 1, "max(abs(x-0.5),abs(y-0.5))-0.25", 0.1);
  add_probe(s, ProbeKind::surface_height, {0.5, 0.5, 0});
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 2) sim->step(2);
  const double radius = 0.5 / std::sqrt(pi);
  WARN("radius " << sim->probe(0).value - 0.5 << " of " << radius << ", speed " << sim->stats().max_speed);
  CHECK(sim->probe(0).value - 0.5 == Approx(radius).epsilon(5e-3));
}
