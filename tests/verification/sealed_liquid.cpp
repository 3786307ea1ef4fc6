// Liquid sealed in cavities of elastic bodies keeps its volume when they are squeezed.
#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "base/scene.h"
#include "elastic_scenes.h"
#include "exchange.h"
#include "solid/body/enclosed_volume.h"
#include "solid/mesh/mesh.h"

namespace sealed_liquid_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double inner = 0.2, outer = 0.3;

SolidSpec hollow_body(int dim, double element_size) {
  const std::string z = dim == 2 ? "" : "+(z-0.5)^2";
  SolidSpec bag = elastic_solid("bag", 1100, {1e5, 0.4}, element_size);
  if (dim == 3) bag.elastic.element_order = 1;  // a tenth of the run time
  bag.shape.kind = "expression";
  bag.shape.phi = fmt::format("abs(sqrt((x-0.5)^2+(y-0.5)^2{})-{})-{}", z, (inner + outer) / 2, (outer - inner) / 2);
  return bag;
}

// A ring (3D: hollow ball) full of liquid between two plates that approach at `speed`.
Scene squeezed_bag(int dim, int cells, double speed, double end, double max_step) {
  Scene s = box_scene(dim, cells);
  s.gravity = {0, -9.81, 0};
  const std::string z = dim == 2 ? "" : "+(z-0.5)^2";
  add_liquid(s, fmt::format("sqrt((x-0.5)^2+(y-0.5)^2{})-0.25", z));
  s.solids.push_back(hollow_body(dim, dim == 2 ? 0.05 : 0.1));
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
  s.time.max_step = max_step;
  return s;
}

// Signed volume between a facet and the middle of the domain; at rest it is negative for facets on the cavity's wall.
template <std::size_t N>
double cone(const SurfaceMesh& surface, const std::array<int, N>& f) {
  const auto p = [&](std::size_t i) { return Vec3(surface.points[std::size_t(f[i])] - Vec3(0.5, 0.5, 0.5)); };
  if constexpr (N == 2)
    return 0.5 * (p(0)[0] * p(1)[1] - p(0)[1] * p(1)[0]);
  else
    return p(0).dot(p(1).cross(p(2))) / 6;
}

// Volume within the facets that form the cavity's wall at rest.
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
  }
  o.steps = sim->step_count();
  o.pressed = sim->stats().elastic_energy;
  return o;
}

// First: error of the identity that the columns of J of a cavity's wall sum to -(dV/du), relative to the largest entry.
// Liquid inside and outside makes two cavities. Second: error of the flux that the linearisation lacks, against dV/du
// at the middle of the path, which is exact in 2D and second order in 3D.
template <int Dim>
std::pair<double, double> sweeping_errors() {
  Scene scene = box_scene(Dim, Dim == 2 ? 24 : 16);
  scene.solids.push_back(hollow_body(Dim, 0.1));
  Dice dice{std::mt19937(5)};
  Projection<Dim> p(scene, Filling::closed, 1, [&](ElasticState& e) {
    for (double& u : e.u) u = dice(-1e-3, 1e-3);
  });
  REQUIRE(p.coupling.cavities.size() == 2);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(p.coupling.size()), w = sums;
  p.coupling.J.for_each([&](int, int column, double value) { sums[column] += value; });
  for (double& x : w) x = dice(-0.1, 0.1);
  CHECK(p.coupling.cavities[0].volume * p.coupling.cavities[1].volume < 0);
  double column_error = 0, flux_error = 0;
  for (const auto& cavity : p.coupling.cavities) {
    const Eigen::VectorXd& gradient = cavity.gradient[0];
    const Eigen::VectorXd wanted = -gradient / cavity.face_area;
    const Eigen::VectorXd error = (gradient.array() == 0).select(0, sums - wanted);
    column_error = std::max(column_error, error.cwiseAbs().maxCoeff() / wanted.cwiseAbs().maxCoeff());
    const Eigen::VectorXd& u = cavity.u[0];
    const double cavities = enclosed_volume(cavity.walls, {u + dt * w}) - enclosed_volume(cavity.walls, {u});
    const Eigen::VectorXd middle = u + 0.5 * dt * w;
    const double linear = dt * enclosed_volume_gradient(cavity.walls, 0, middle).dot(w);
    const double flux = cavity.missing_flux(w) * cavity.face_area;
    flux_error = std::max(flux_error, std::abs(flux - gradient.dot(w) + linear / dt) / std::abs(cavities / dt));
  }
  return {column_error, flux_error};
}

// A box full of liquid, with walls on all sides.
Scene full_box(int dim, int cells) {
  Scene s = box_scene(dim, cells);
  add_liquid(s, "-1");
  return s;
}

// A disc (3D: ball) of 1 MPa that spins at 6 rad/s in the middle of the box.
SolidSpec spinning_body(int dim, double element_size) {
  SolidSpec body = elastic_solid("body", 1500, {1e6, 0.4}, element_size);
  body.shape.kind = "sphere";
  body.shape.center = {0.5, 0.5, dim == 2 ? 0.0 : 0.5};
  body.shape.radius = 0.2;
  body.rigid.angular_velocity = {0, 0, 6};
  if (dim == 3) body.elastic.element_order = 1;
  return body;
}

// Kinetic and elastic energy (J) at `end`, in steps of at most 0.01 s.
double energy_at(Scene s, double end) {
  s.time.end = end;
  s.time.max_step = 0.01;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < end) sim->step(end);
  return sim->stats().kinetic_energy + sim->stats().elastic_energy;
}

void check_spins_on(int dim, int cells, double element_size, double bar) {
  Scene wet = full_box(dim, cells), dry = box_scene(dim, cells);
  wet.solids = dry.solids = {spinning_body(dim, element_size)};
  const double alone = energy_at(dry, 0.5), in_liquid = energy_at(wet, 0.5);
  WARN(dim << "D: " << in_liquid << " J after 0.5 s, " << alone << " J without liquid, bar " << bar);
  CHECK(std::abs(in_liquid / alone - 1) <= bar);
}

// Water between two elastic walls pinned to the floor and to a descending plate.
Scene flooded_bellows() {
  Scene s = box_scene(2, 80);
  s.gravity = {0, -9.81, 0};
  s.domain.cells[1] = 48, s.domain.upper[1] = 0.6;
  add_liquid(s, "max(abs(x-0.5)-0.18, y-0.42)");
  const std::string motion = "-0.04*(1-cos(3.1415926535897932*t))";
  for (const int side : {0, 1}) {
    const double x = side == 0 ? 0.3 : 0.66;
    SolidSpec wall = elastic_box(side == 0 ? "low" : "high", {x, 0, 0}, {x + 0.04, 0.4, 0}, 1100, {3e5, 0.45}, 0.02);
    wall.elastic.damping = 2e-3;
    pin(wall, {0, -0.1, 0}, {1, 0, 0});
    pin(wall, {0, 0.4, 0}, {1, 0.5, 0});
    wall.elastic.pinned.back().motion.translate[1] = motion;
    s.solids.push_back(wall);
  }
  SolidSpec plate;
  plate.name = "plate";
  plate.kind = SolidKind::kinematic;
  plate.shape.where = "test";
  plate.shape.kind = "box";
  plate.shape.lower = {0.2, 0.400001, 0};  // above the walls, without overlap
  plate.shape.upper = {0.8, 0.46, 0};
  plate.motion.translate = {"0", motion, "0"};
  s.solids.push_back(plate);
  return s;
}

// Area between the inner sides of both walls, floor and plate: trapezia between the sides' points, upwards along the
// wall at low x and downwards along the other.
double bellows_volume(const Simulation& sim, const std::array<SurfaceMesh, 2>& at_rest) {
  std::vector<Vec3> loop;
  for (std::size_t k : {0, 1}) {
    std::vector<std::pair<double, Vec3>> inner;
    const SurfaceMesh now = sim.solid_surface(k);
    for (std::size_t n = 0; n < now.points.size(); ++n)
      if (std::abs(at_rest[k].points[n][0] - (k == 0 ? 0.34 : 0.66)) < 1e-9)
        inner.emplace_back((k == 0 ? 1 : -1) * at_rest[k].points[n][1], now.points[n]);
    std::sort(inner.begin(), inner.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [height, x] : inner) loop.push_back(x);
  }
  double area = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Vec3 &a = loop[n], &b = loop[(n + 1) % loop.size()];
    area -= 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

// Writes a square tube 0.6 m across, with walls 0.1 m thick, 0.4 m high, as a mesh file.
void write_tube(const std::filesystem::path& file) {
  const ElasticMesh<3> block = box_mesh<3>({0.2, 0, 0.2}, {0.8, 0.4, 0.8}, {6, 4, 6}, 1);
  std::ofstream out(file);
  out.precision(17);
  out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << block.nodes.size() << "\n";
  for (const Vec3& x : block.nodes) out << x[0] << " " << x[1] << " " << x[2] << " 0\n";
  std::string elements;
  int count = 0;
  for (int e = 0; e < block.element_count(); ++e) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 4; ++k) middle += block.nodes[std::size_t(block.element(e)[k])] / 4;
    if (std::max(std::abs(middle[0] - 0.5), std::abs(middle[2] - 0.5)) < 0.2) continue;
    for (int k = 0; k < 4; ++k) elements += std::to_string(block.element(e)[k] + 1) + " ";
    elements += "0\n";
    ++count;
  }
  out << "Tetrahedra\n" << count << "\n" << elements << "End\n";
}

// Water in the tube, between the floor and a descending plate.
Scene flooded_tube(const std::filesystem::path& file) {
  Scene s = box_scene(3, 20);
  s.gravity = {0, -9.81, 0};
  s.domain.cells[1] = 12, s.domain.upper[1] = 0.6;
  add_liquid(s, "max(max(abs(x-0.5), abs(z-0.5))-0.25, y-0.46)");
  SolidSpec tube = elastic_solid("tube", 1100, {1e5, 0.4}, 0.1);
  tube.shape.kind = "mesh";
  tube.shape.file = file.string();
  tube.elastic.element_order = 1;
  pin(tube, {0, -0.1, 0}, {1, 0, 1});
  pin(tube, {0, 0.4, 0}, {1, 0.5, 1});
  SolidSpec plate;
  plate.name = "plate";
  plate.kind = SolidKind::kinematic;
  plate.shape.where = "test";
  plate.shape.kind = "box";
  plate.shape.lower = {0.1, 0.40015, 0.1};  // 3e-3 cells above the tube
  plate.shape.upper = {0.9, 0.5, 0.9};
  plate.motion.translate[1] = tube.elastic.pinned.back().motion.translate[1] = "-0.02*(1-cos(3.1415926535897932*t))";
  s.solids = {tube, plate};
  s.time.end = 0.3;
  s.time.max_step = 0.01;
  return s;
}

// Volume within the inner sides, floor and plate, as cones from the middle of the floor.
double tube_volume(const SurfaceMesh& at_rest, const SurfaceMesh& now) {
  const Vec3 seen_from(0.5, 0, 0.5);
  double volume = 0, top = 0;
  for (const auto& f : now.triangles) {
    const auto is_inner = [&](int p) {
      const Vec3& x = at_rest.points[std::size_t(p)];
      return std::max(std::abs(x[0] - 0.5), std::abs(x[2] - 0.5)) < 0.2 + 1e-9;
    };
    if (!std::all_of(f.begin(), f.end(), is_inner)) continue;
    const auto p = [&](std::size_t i) { return Vec3(now.points[std::size_t(f[i])] - seen_from); };
    volume -= p(0).dot(p(1).cross(p(2))) / 6;
    for (std::size_t i = 0; i < 3; ++i) top = std::max(top, p(i)[1]);
  }
  return volume + 0.4 * 0.4 * top / 3;
}

void check_kept(const Outcome& o) {
  WARN(o.steps << " steps: volume off by " << o.worst << ", in a step " << o.worst_step << "; divergence "
               << o.divergence << ", elastic energy " << o.pressed << " J, Newton " << o.first_newton << " and "
               << o.last_newton);
  CHECK(o.steps >= 100);
  CHECK(o.worst <= 1e-8);
  CHECK(o.last_newton <= 5 * o.steps);  // ten a step in the second half
}

}  // namespace

TEST_CASE("what a body in closed liquid pushes out adds up to what its surface sweeps", "[elastic][sealed]") {
  const auto flat = sweeping_errors<2>(), solid = sweeping_errors<3>();
  WARN("columns of J off by " << flat.first << ", " << solid.first << ", bar 1e-12; the flux they lack by "
                              << flat.second << ", " << solid.second << ", bar 1e-10, 1e-3");
  CHECK(std::max(flat.first, solid.first) <= 1e-12);
  CHECK(flat.second <= 1e-10);
  CHECK(solid.second <= 1e-3);  // displacements of 1e-3 m: (1e-3/0.2)^2 is far below the bar
}

// Ideal liquid has no hold on a body of revolution that spins about its axis. The facets are chords, whose corners push
// liquid about: (1 - cos(angle of a facet/2)) of the radius, below 1 %.
TEST_CASE("an elastic disc spins on in a full box", "[elastic][sealed]") {
  check_spins_on(2, 20, 0.05, 0.01);
  check_spins_on(2, 32, 0.05, 0.01);  // cells beside it are nearly shut
}

TEST_CASE("an elastic ball spins on in a full box", "[elastic][sealed][long]") {
  check_spins_on(3, 16, 0.1, 0.02);
}

TEST_CASE("a soft flap that stands on the floor of a full box comes to rest", "[elastic][sealed]") {
  Scene s = full_box(2, 20);
  s.gravity = {0, -9.81, 0};
  s.solids = {elastic_box("flap", {0.45, 0, 0}, {0.55, 0.6, 0}, 1100, {2e5, 0.4}, 0.05)};
  pin(s.solids[0], {0, -0.1, 0}, {1, 0, 0});
  s.solids[0].rigid.velocity = {0.05, 0, 0};
  s.time.end = 3;
  const auto sim = make_simulation(s, Communicator());
  double most = 0;
  while (sim->time() < s.time.end) {
    const double kinetic = sim->step(s.time.end).kinetic_energy;
    if (sim->time() > 2) most = std::max(most, kinetic);
  }
  WARN("kinetic energy from 2 s on: at most " << most << " J");
  CHECK(most < 1e-2);  // 0.05 to 0.09 J for ever when such flaps were held to their volume
}

TEST_CASE("a ring full of liquid keeps what it holds while plates squeeze it", "[elastic][sealed][long]") {
  check_kept(squeeze(squeezed_bag(2, 40, 0.15, 0.5, 4e-3)));
}

TEST_CASE("a hollow ball full of liquid keeps what it holds while plates squeeze it", "[elastic][sealed][long]") {
  check_kept(squeeze(squeezed_bag(3, 20, 0.15, 0.2, 2e-3)));
}

TEST_CASE("liquid that two walls, floor and plate close off keeps its volume", "[elastic][sealed]") {
  const auto sim = make_simulation(flooded_bellows(), Communicator());
  const std::array<SurfaceMesh, 2> at_rest = {sim->solid_surface(0), sim->solid_surface(1)};
  const double start = bellows_volume(*sim, at_rest);
  REQUIRE(start == Approx(0.32 * 0.4));
  double worst = 0, divergence = 0;
  while (sim->time() < 0.5) {
    const StepStats step = sim->step(0.5);
    worst = std::max(worst, std::abs(bellows_volume(*sim, at_rest) / start - 1));
    divergence = std::max(divergence, step.max_divergence);
  }
  WARN("a plate displaces a tenth in " << sim->step_count() << " steps: volume off by " << worst
                                       << ", bar 1e-8; divergence " << divergence);
  CHECK(worst <= 1e-8);
}

TEST_CASE("liquid that a tube, floor and plate close off keeps its volume", "[elastic][sealed][long]") {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("seiche_tube_{}.mesh", std::random_device()());
  write_tube(file);
  const Scene scene = flooded_tube(file);
  const auto sim = make_simulation(scene, Communicator());
  std::filesystem::remove(file);
  const SurfaceMesh at_rest = sim->solid_surface(0);
  const double start = tube_volume(at_rest, at_rest);
  REQUIRE(start == Approx(0.4 * 0.4 * 0.4));
  double worst = 0, divergence = 0;
  while (sim->time() < scene.time.end) {
    const StepStats step = sim->step(scene.time.end);
    worst = std::max(worst, std::abs(tube_volume(at_rest, sim->solid_surface(0)) / start - 1));
    divergence = std::max(divergence, step.max_divergence);
  }
  WARN("a plate displaces a fiftieth in " << sim->step_count() << " steps: volume off by " << worst
                                          << ", bar 1e-8; divergence " << divergence << ", elastic energy "
                                          << sim->stats().elastic_energy << " J");
  CHECK(worst <= 1e-8);
  CHECK(sim->stats().elastic_energy > 0);
}

// Both phases are sealed below the lid. The volume constraint of sealed liquid must not take the bubble for liquid.
TEST_CASE("a bubble that an elastic lid and walls seal in stays gas", "[elastic]") {
  Scene s = box_scene(2, 16);
  s.gravity = {0, -1, 0};
  add_liquid(s, "0.2-sqrt((x-0.5)^2+(y-0.35)^2)");
  s.liquid.density = 1000;
  s.gas.present = true;
  s.gas.density = 1;
  s.solids.push_back(elastic_box("lid", {0, 0.7, 0}, {1, 0.85, 0}, 1000, {1e5, 0.4}, 0.15));
  pin(s.solids[0], {-0.1, 0.6, 0}, {0.01, 0.9, 0});
  pin(s.solids[0], {0.99, 0.6, 0}, {1.1, 0.9, 0});
  s.time.fixed_step = 0.01;
  const auto sim = make_simulation(s, Communicator());
  const StepStats before = sim->stats();
  StepStats after;
  for (int n = 0; n < 5; ++n) after = sim->step(1);
  CHECK(before.gas_volume > 0.1);
  CHECK(after.gas_volume == Approx(before.gas_volume).epsilon(0.01));  // the volume control allows for the lid's motion
  CHECK(after.liquid_volume == Approx(before.liquid_volume).epsilon(0.01));
}

}  // namespace sealed_liquid_tests
