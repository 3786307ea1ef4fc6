// Meshing of shapes: volume, quality, order of the fit, faults, and reproducible meshes.
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"
#include "base/solid_spec.h"
#include "solid/body/thinness.h"
#include "solid/elastic/solid.h"
#include "solid/mesh/outline.h"
#include "unit/solid/elastic_cases.h"

namespace elastic_meshing_tests {
using namespace seiche;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr double pi = 3.14159265358979323846;

SolidSpec solid_of(const std::string& kind, double size, int order = 2) {
  SolidSpec s;
  s.name = "body";
  s.kind = SolidKind::elastic;
  s.shape.kind = kind;
  s.shape.where = "scene.toml:3";
  s.rigid.density = 1000;
  s.elastic.youngs_modulus = 1e6;
  s.elastic.poisson_ratio = 0.3;
  s.elastic.element_size = size;
  s.elastic.element_order = order;
  return s;
}

SolidSpec ball(double radius, double size, int order = 2) {
  SolidSpec s = solid_of("sphere", size, order);
  s.shape.center = {0.4, 0.5, 0.3};
  s.shape.radius = radius;
  return s;
}

SolidSpec block(const Vec3& lower, const Vec3& upper, double size, int order = 2) {
  SolidSpec s = solid_of("box", size, order);
  s.shape.lower = lower;
  s.shape.upper = upper;
  return s;
}

template <int Dim>
ElasticSolid<Dim> make(const SolidSpec& spec, std::vector<std::string>* notes = nullptr) {
  return make_elastic_solid<Dim>(spec, {0.05, notes}, Vec<Dim>::Constant(-1), Vec<Dim>::Constant(2));
}

template <int Dim>
std::string fault(const SolidSpec& spec) {
  try {
    make<Dim>(spec);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  FAIL_CHECK("it was accepted");
  return "";
}

// Volume by the mass matrix: exact also for curved sides.
template <int Dim>
double volume(const ElasticSolid<Dim>& solid) {
  double sum = 0;
  for (const double w : solid.body.weights) sum += w;
  return sum;
}

// A torus about the y axis.
std::string torus_obj(int around, int across) {
  std::string text;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * pi * i / around, b = 2 * pi * j / across, r = 0.3 + 0.1 * std::cos(b);
      text += fmt::format("v {} {} {}\n", r * std::cos(a), 0.1 * std::sin(b), r * std::sin(a));
    }
  }
  const auto point = [&](int i, int j) { return i % around * across + j % across + 1; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      text += fmt::format("f {} {} {}\n", point(i, j), point(i, j + 1), point(i + 1, j + 1));
      text += fmt::format("f {} {} {}\n", point(i, j), point(i + 1, j + 1), point(i + 1, j));
    }
  }
  return text;
}

template <int Dim>
void check_shape(const char* what, const SolidSpec& spec, double exact, double tolerance, double worst) {
  std::vector<std::string> notes;
  const ElasticSolid<Dim> solid = make<Dim>(spec, &notes);
  const MeshQuality q = mesh_quality(solid.body.mesh);
  const double error = volume(solid) / exact - 1, size = spec.elastic.element_size;
  WARN(Dim << "D " << what << ": " << q.nodes << " nodes, " << q.elements << " elements, volume error " << error
           << ", quality worst " << q.worst << ", mean " << q.mean << ", edges " << q.shortest_edge / size << " to "
           << q.longest_edge / size << " sizes");
  CHECK(std::abs(error) < tolerance);
  CHECK(q.worst > worst);
  CHECK(q.mean > 0.7);
  CHECK(q.longest_edge < 2 * size);
}

}  // namespace

// Tolerances: chords of a surface with this element size, squared for quadratic sides; a rim is a polygon.
TEST_CASE("2D shapes become triangles that fill them", "[elastic][meshing]") {
  check_shape<2>("box", block({0, 0, 0}, {0.31, 0.2, 0}, 0.05), 0.062, 1e-12, 0.8);
  check_shape<2>("disc", ball(0.3, 0.1), pi * 0.09, 1e-4, 0.5);
  SolidSpec capsule = solid_of("capsule", 0.05);
  capsule.shape.from = {0, 0, 0};
  capsule.shape.to = {0.5, 0.2, 0};
  capsule.shape.radius = 0.1;
  check_shape<2>("capsule", capsule, std::hypot(0.5, 0.2) * 0.2 + pi * 0.01, 1e-4, 0.5);
  SolidSpec bar = solid_of("cylinder", 0.05);
  bar.shape.from = {0, 0, 0};
  bar.shape.to = {0.5, 0.2, 0};
  bar.shape.radius = 0.1;
  check_shape<2>("cylinder", bar, std::hypot(0.5, 0.2) * 0.2, 1e-9, 0.5);
  SolidSpec ring = solid_of("expression", 0.05);
  ring.shape.phi = "max(sqrt(x*x+y*y)-0.4, 0.25-sqrt(x*x+y*y))";
  check_shape<2>("ring", ring, pi * (0.16 - 0.0625), 1e-4, 0.5);
  SolidSpec bowl = solid_of("expression", 0.04);
  bowl.shape.phi = "max(max(sqrt(x*x+y*y)-0.4, 0.3-sqrt(x*x+y*y)), y)";
  check_shape<2>("bowl", bowl, pi * (0.16 - 0.09) / 2, 1e-2, 0.4);
}

TEST_CASE("3D shapes become tetrahedra that fill them", "[elastic][meshing][long]") {
  check_shape<3>("box", block({0, 0, 0}, {0.3, 0.2, 0.1}, 0.05), 0.006, 1e-12, 0.7);
  check_shape<3>("ball", ball(0.3, 0.12), 4 * pi / 3 * 0.027, 2e-3, 0.15);
  SolidSpec rod = solid_of("cylinder", 0.08);
  rod.shape.from = {0, 0, 0};
  rod.shape.to = {0.4, 0.1, 0.2};
  rod.shape.radius = 0.12;
  check_shape<3>("cylinder", rod, pi * 0.0144 * std::sqrt(0.21), 2e-2, 0.15);
  SolidSpec capsule = rod;
  capsule.shape.kind = "capsule";
  check_shape<3>("capsule", capsule, pi * 0.0144 * std::sqrt(0.21) + 4 * pi / 3 * 0.001728, 2e-3, 0.15);
  SolidSpec bowl = solid_of("expression", 0.08);
  bowl.shape.phi = "max(max(sqrt(x*x+y*y+z*z)-0.4, 0.28-sqrt(x*x+y*y+z*z)), y)";
  check_shape<3>("bowl", bowl, 2 * pi / 3 * (0.064 - 0.021952), 2e-2, 0.1);
}

TEST_CASE("A closed surface from a file becomes tetrahedra", "[elastic][meshing][long]") {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("seiche_torus_{}.obj", getpid());
  std::ofstream(file) << torus_obj(40, 20);
  SolidSpec torus = solid_of("mesh", 0.08);
  torus.shape.file = file;
  torus.shape.transform.scale = 1.5;
  torus.shape.transform.translate = {0.5, 0, 0};
  const double polygon = std::sin(2 * pi / 20) / (2 * pi / 20) * std::sin(2 * pi / 40) / (2 * pi / 40);
  check_shape<3>("torus", torus, 2 * pi * pi * 0.3 * 0.01 * 3.375 * polygon, 2e-2, 0.1);
  std::filesystem::remove(file);
}

TEST_CASE("Quadratic sides follow round shapes", "[elastic][meshing]") {
  const double exact = pi * 0.09;
  const auto error = [&](double size, int order) {
    return std::abs(volume(make<2>(ball(0.3, size, order))) / exact - 1);
  };
  const double linear = std::log2(error(0.1, 1) / error(0.05, 1)),
               quadratic = std::log2(error(0.1, 2) / error(0.05, 2));
  WARN("volume of a disc: order " << linear << " with straight sides, " << quadratic << " with quadratic ones; error "
                                  << error(0.1, 1) << ", " << error(0.1, 2));
  // Orders 2 and 4, reduced since refinement splits some of the coarse sides.
  CHECK(linear > 1.5);
  CHECK(quadratic > 3.2);
  CHECK(error(0.1, 2) < error(0.1, 1) / 100);
}

TEST_CASE("A plate thinner than its elements has one across", "[elastic][meshing]") {
  const auto plate = make<3>(block({0, 0, 0}, {0.4, 0.01, 0.2}, 0.1));
  CHECK(plate.body.mesh.element_count() == 6 * 4 * 2);
  const auto strip = make<2>(block({0, 0, 0}, {0.01, 0.3, 0}, 0.05));
  CHECK(strip.body.mesh.element_count() == 2 * 6);
  SolidSpec disc = solid_of("cylinder", 0.1);
  disc.shape.to = {0, 0.03, 0};
  disc.shape.radius = 0.25;
  const auto coin = make<3>(disc);
  WARN("coin, 0.3 elements thick: " << describe_mesh("coin", coin.body.mesh));
  CHECK(std::abs(volume(coin) / (pi * 0.0625 * 0.03) - 1) < 0.03);
  CHECK(mesh_quality(coin.body.mesh).longest_edge < 0.2);
}

TEST_CASE("The same scene gives the same mesh", "[elastic][meshing]") {
  SolidSpec bowl = solid_of("expression", 0.1);
  bowl.shape.phi = "max(max(sqrt(x*x+y*y+z*z)-0.4, 0.28-sqrt(x*x+y*y+z*z)), y)";
  for (const SolidSpec& spec : {ball(0.3, 0.15), bowl}) {
    const auto first = make<3>(spec);
    make<3>(ball(0.2, 0.12));  // earlier meshes must not matter
    const std::vector<double> heap(123457);
    const auto second = make<3>(spec);
    CHECK(first.body.mesh.elements == second.body.mesh.elements);
    CHECK(first.body.mesh.nodes == second.body.mesh.nodes);
  }
  CHECK(make<2>(ball(0.3, 0.1)).body.mesh.nodes == make<2>(ball(0.3, 0.1)).body.mesh.nodes);
}

TEST_CASE("Boxes are cut along their own axes", "[elastic][meshing]") {
  SolidSpec spec = block({0, 0, 0}, {0.2, 0.1, 0.1}, 0.1, 1);
  spec.shape.transform = {2, {{0, 0, 1}, 90}, {1, 0, 0}};
  const auto solid = make<3>(spec);
  CHECK(solid.body.mesh.element_count() == 6 * 4 * 2 * 2);
  for (const auto& x : solid.body.mesh.nodes) {
    CHECK(x[0] > 0.8 - 1e-12);
    CHECK(x[1] < 0.4 + 1e-12);
  }
  CHECK(volume(solid) == Approx(0.002 * 8));
  // 0.3 / 0.1 is not 3 in binary.
  CHECK(make<2>(block({0, 0, 0}, {0.3, 0.1, 0}, 0.1, 1)).body.mesh.element_count() == 2 * 3);
}

TEST_CASE("Elements that cannot be made are refused in words", "[elastic][meshing]") {
  CHECK_THAT(
      fault<3>(ball(0.1, 0.3)),
      StartsWith("scene.toml:3: solid 'body': element_size = 0.3 m is larger than the solid, whose longest extent "
                 "is 0.2"));
  CHECK_THAT(fault<2>(block({0, 0, 0}, {0.1, 0.2, 0}, 0.3)), Contains("larger than the solid"));
  CHECK_THAT(fault<3>(ball(0.3, 1e-3)), Contains("would make about") && Contains("make it 0.0"));
  CHECK_THAT(fault<3>(block({0, 0, 0}, {1, 1, 1}, 1e-4)), Contains("would make about"));
  CHECK_THAT(fault<3>(block({0, 0, 0}, {1, 1e-8, 1}, 1e-4)), Contains("raise it"));
  SolidSpec fine = solid_of("expression", 1e-5);
  fine.shape.phi = "sqrt(x*x+y*y)-0.2";
  CHECK_THAT(fault<3>(fine), Contains("raise element_size"));
  SolidSpec two = solid_of("expression", 0.05);
  two.shape.phi = "min(sqrt(x*x+y*y)-0.2, sqrt((x-1)*(x-1)+y*y)-0.2)";
  CHECK_THAT(fault<2>(two), Contains("do not hang together"));
  SolidSpec comb = solid_of("expression", 0.05);  // two elements wide, with parts of half an element
  comb.shape.phi = "max(sqrt((x-0.5)^2+(y-0.6)^2)-0.2,sin(100*x)*sin(100*y))";
  CHECK_THAT(fault<2>(comb), Contains("lower element_size"));
  SolidSpec sheet = solid_of("cylinder", 0.1);
  sheet.shape.to = {0, 3e-7, 0};
  sheet.shape.radius = 0.3;
  CHECK_THAT(fault<3>(sheet), Contains("it is about 3e-07 m thick") && Contains("make it thicker"));
  SolidSpec none = solid_of("expression", 0.05);
  none.shape.phi = "1";
  CHECK_THAT(fault<2>(none), Contains("empty within the domain"));
  CHECK_THAT(fault<3>(none), Contains("empty within the domain"));
}

TEST_CASE("Pins hold the nodes that lie in them", "[elastic][meshing]") {
  SolidSpec spec = block({0, 0, 0}, {0.1, 0.4, 0}, 0.05);
  PinSpec pin;
  pin.shape.kind = "box";
  pin.shape.lower = {-1, -1, 0};
  pin.shape.upper = {1, 0, 0};
  pin.shape.where = "scene.toml:9";
  pin.motion.translate = {"0.1*t", "0", "0"};
  pin.motion.degrees = "90*t";
  spec.elastic.pinned = {pin, pin};
  const auto solid = make<2>(spec);
  REQUIRE(solid.pins.size() == 2);
  CHECK(solid.pins[0].nodes.size() == 5);  // lowest side: two elements of order 2
  CHECK(solid.pins[1].nodes.empty());      // already pinned
  const Pins pins = pins_at(solid, 1);
  REQUIRE(pins.dofs.size() == 10);
  CHECK(std::is_sorted(pins.dofs.begin(), pins.dofs.end()));
  for (std::size_t i = 0; i < pins.dofs.size(); i += 2) {
    const Vec<2> X = solid.body.mesh.nodes[std::size_t(pins.dofs[i] / 2)];  // moves to (0.1 - y, x)
    CHECK(pins.targets[i] == Approx(0.1 - X[1] - X[0]).margin(1e-15));
    CHECK(pins.targets[i + 1] == Approx(X[0] - X[1]).margin(1e-15));
  }
  spec.elastic.pinned[1].motion.degrees = "0";
  CHECK_THAT(fault<2>(spec), Contains("scene.toml:9: two pinned shapes of solid 'body' move differently but share "
                                      "5 node(s)"));
  spec.elastic.pinned = {pin};
  spec.elastic.pinned[0].shape.upper[1] = -0.25;
  CHECK_THAT(fault<2>(spec), Contains("scene.toml:9: the pinned shape of solid 'body' contains none of its") &&
                                 Contains("the nearest lies 0.25 m outside"));
}

TEST_CASE("Forces on an elastic solid add up", "[elastic][meshing]") {
  SolidSpec spec = block({0, 0, 0}, {0.1, 0.4, 0.2}, 0.05);
  CHECK(applied_force_at(make<3>(spec), 0).size() == 0);
  spec.elastic.body_force = {"0", "100*t", "x"};
  const Eigen::VectorXd f = applied_force_at(make<3>(spec), 2);
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index n = 0; n < f.size() / 3; ++n) sum += f.segment<3>(3 * n);
  CHECK(sum[0] == Approx(0).margin(1e-12));
  CHECK(sum[1] == Approx(200 * 0.008));
  CHECK(sum[2] == Approx(0.05 * 0.008));
  // Tractions on the upper side, 0.1 by 0.2, and on the lower half of the side z = 0.2.
  TractionSpec upper{{}, {"0", "50*t", "z"}}, side{{}, {"0", "0", "8"}};
  upper.shape = spec.shape, side.shape = spec.shape;
  upper.shape.where = side.shape.where = "scene.toml:12";
  upper.shape.lower = {-1, 0.4, -1}, upper.shape.upper = {1, 1, 1};
  side.shape.lower = {-1, -1, 0.2}, side.shape.upper = {1, 0.2, 1};
  spec.elastic.tractions = {upper, side};
  const Eigen::VectorXd more = applied_force_at(make<3>(spec), 2) - f;
  sum.setZero();
  for (Eigen::Index n = 0; n < more.size() / 3; ++n) sum += more.segment<3>(3 * n);
  CHECK(sum[0] == Approx(0).margin(1e-12));
  CHECK(sum[1] == Approx(50 * 2 * 0.1 * 0.2));
  CHECK(sum[2] == Approx(0.1 * 0.2 * 0.1 + 8 * 0.1 * 0.2));
  spec.elastic.tractions[1].shape.lower[2] = 0.3;
  CHECK_THAT(fault<3>(spec),
             Contains("scene.toml:12: the traction shape of solid 'body' contains no whole boundary face "
                      "of an element; the nearest face reaches 0.1 m beyond it"));
  spec.elastic.tractions = {upper};
  spec.elastic.tractions[0].stress = {"0", "1/(y-0.4)", "0"};
  CHECK_THAT(fault<3>(spec), Contains("scene.toml:12: traction of solid 'body' is not a finite number"));
  spec.elastic.body_force = {"0", "1/(x-x)", "0"};
  CHECK_THAT(fault<3>(spec), Contains("body_force of solid 'body' is not a finite number"));
}

TEST_CASE("An outline keeps its corners and its length", "[elastic][meshing]") {
  SurfaceMesh square;
  for (int i = 0; i < 400; ++i) {
    const double s = i / 100.;
    const double x = s < 1 ? s : s < 2 ? 1 : s < 3 ? 3 - s : 0, y = s < 1 ? 0 : s < 2 ? s - 1 : s < 3 ? 1 : 4 - s;
    square.points.push_back({x, y, 0});
    square.segments.push_back({i, (i + 1) % 400});
  }
  const SurfaceMesh coarse = resample_outline(square, 0.3);
  CHECK(coarse.points.size() == 16);
  double length = 0;
  for (const auto& [a, b] : coarse.segments) {
    const double d = (coarse.points[std::size_t(a)] - coarse.points[std::size_t(b)]).norm();
    CHECK(d <= 0.3);
    length += d;
  }
  CHECK(length == Approx(4));
}

// Plates 0.04 m thick with one and with four elements across, balls 0.2 m across.
TEST_CASE("an elastic solid is thin where no ball of the cell's size fits into it") {
  for (const double size : {0.1, 0.01}) {
    CAPTURE(size);
    const auto plate = make<2>(block({0, 0, 0}, {0.04, 0.4, 0}, size));
    CHECK(is_thinner_than(plate, 0.041));
    CHECK_FALSE(is_thinner_than(plate, 0.039));
  }
  for (const int order : {1, 2}) {
    CAPTURE(order);
    const auto plate = make<3>(block({0, 0, 0}, {0.3, 0.04, 0.3}, 0.05, order)),
               round = make<3>(ball(0.1, 0.05, order));
    CHECK(is_thinner_than(plate, 0.041));
    CHECK_FALSE(is_thinner_than(plate, 0.039));
    CHECK(is_thinner_than(round, 0.21));
    CHECK_FALSE(is_thinner_than(round, 0.15));
  }
}

}  // namespace elastic_meshing_tests
