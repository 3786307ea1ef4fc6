// No accepted state of the program's steps has intersecting surfaces: the scenes of scenes/ with rigid or elastic
// solids, and random dam breaks onto boxes, balls and meshes between obstacles and a paddle.
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <random>
#include <set>

#include "base/scene.h"
#include "elastic_scenes.h"
#include "exact_intersections.h"
#include "rigid_scenes.h"
#include "scene/reader.h"
#include "solid/body/body.h"

using namespace seiche;
using exact::Mobility;
using exact::PlacedSurface;

namespace {

// Surfaces of a simulation's solids: rigid and elastic ones at their current positions, others at their prescribed
// poses.
class Surfaces {
 public:
  explicit Surfaces(const Scene& scene) : dimension_(scene.dimension) {
    if (dimension_ == 2) make_bodies(scene, flat_);
    if (dimension_ == 3) make_bodies(scene, solid_);
  }
  std::vector<PlacedSurface> at(const Simulation& sim) const {
    return dimension_ == 2 ? placed(flat_, sim) : placed(solid_, sim);
  }

 private:
  template <int Dim>
  static void make_bodies(const Scene& scene, std::vector<Body<Dim>>& bodies) {
    for (const SolidSpec& spec : scene.solids)
      bodies.emplace_back(spec, ShapeOptions{scene.domain.cell_size, nullptr}, truncate<Dim>(scene.domain.lower),
                          truncate<Dim>(scene.domain.upper));
  }
  template <int Dim>
  static std::vector<PlacedSurface> placed(const std::vector<Body<Dim>>& bodies, const Simulation& sim) {
    std::vector<PlacedSurface> list;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const SolidKind kind = bodies[k].spec().kind;
      if (kind == SolidKind::rigid || kind == SolidKind::elastic) {
        const auto mobility = kind == SolidKind::rigid ? Mobility::free : Mobility::deformable;
        list.push_back({sim.solid_surface(k), mobility});
        continue;
      }
      list.push_back({bodies[k].contact_surface(), Mobility::prescribed});
      const Pose pose = bodies[k].pose(sim.time());
      for (Vec3& x : list.back().mesh.points) x = pose.apply(x);
    }
    return list;
  }
  int dimension_;
  std::vector<Body<2>> flat_;
  std::vector<Body<3>> solid_;
};

struct Faults {
  int crossings = 0, outside = 0, wound = 0;  // summed over the states
  int most_contacts = 0;
  double least_volume = 1;  // det F of elastic solids
};

// Gradients of a simplex's shape functions with respect to barycentric coordinates; nodes in VTK order. Row a belongs
// to node a.
Eigen::MatrixXd barycentric_gradients(const Eigen::VectorXd& at, int nodes) {
  static const std::array<std::array<int, 2>, 6> sides{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  const int n = int(at.size());
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(nodes, n);
  for (int k = 0; k < n; ++k) g(k, k) = nodes == n ? 1 : 4 * at[k] - 1;
  for (int m = n; m < nodes; ++m) {
    const auto [a, b] = sides[std::size_t(m - n)];
    g(m, a) = 4 * at[b];
    g(m, b) = 4 * at[a];
  }
  return g;
}

// Smallest det F over a lattice of points in each element, corners and sides included, from a frame's data.
double least_volume_ratio(const VolumeFrame& frame) {
  const int dim = frame.dimension, n = dim + 1, nodes = frame.order == 1 ? n : n * (n + 1) / 2;
  double least = 1e300;
  for (std::size_t e = 0; e < frame.elements.size(); e += std::size_t(nodes)) {
    Eigen::MatrixXd X(dim, nodes), x(dim, nodes);
    for (int a = 0; a < nodes; ++a) {
      const auto node = std::size_t(frame.elements[e + std::size_t(a)]);
      X.col(a) = frame.rest[node].head(dim);
      x.col(a) = X.col(a) + frame.displacement[node].head(dim);
    }
    constexpr int parts = 4;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        for (int k = 0; i + j + k <= (dim == 3 ? parts : i + j); ++k) {
          Eigen::VectorXd at(n);
          at[1] = double(i) / parts, at[2] = double(j) / parts;
          if (dim == 3) at[3] = double(k) / parts;
          at[0] = 1 - at.tail(dim).sum();
          const Eigen::MatrixXd g = barycentric_gradients(at, nodes);
          // Derivatives with respect to lambda_1 ... lambda_dim; lambda_0 is one minus their sum.
          const Eigen::MatrixXd d = g.rightCols(dim) - g.col(0).replicate(1, dim);
          least = std::min(least, (x * d).determinant() / (X * d).determinant());
        }
  }
  return least;
}

bool are_joined(const Scene& scene, std::size_t a, std::size_t b) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), [&](const JointSpec& joint) {
    const auto holds = [&](std::size_t k) {
      return std::count(joint.between.begin(), joint.between.end(), scene.solids[k].name);
    };
    return !joint.collide && holds(a) && holds(b);
  });
}

// Surfaces that must not meet: all, or with joints each pair that none holds, since joined solids may overlap.
std::vector<std::vector<PlacedSurface>> strangers(const Scene& scene, const std::vector<PlacedSurface>& all) {
  if (scene.joints.empty()) return {all};
  std::vector<std::vector<PlacedSurface>> pairs;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (!are_joined(scene, a, b)) pairs.push_back({all[a], all[b]});
  return pairs;
}

int crossings(const std::vector<std::vector<PlacedSurface>>& groups) {
  int sum = 0;
  for (const auto& group : groups) sum += exact::intersections(group);
  return sum;
}

std::vector<int> all_windings(const std::vector<std::vector<PlacedSurface>>& groups) {
  std::vector<int> all;
  for (const auto& group : groups)
    for (const int winding : exact::windings(group)) all.push_back(winding);
  return all;
}

Faults run(const Scene& scene, int steps) {
  const auto sim = make_simulation(scene, Communicator());
  const Surfaces surfaces(scene);
  const std::vector<int> windings = all_windings(strangers(scene, surfaces.at(*sim)));
  const int standing = exact::points_outside(surfaces.at(*sim), scene);  // pinned points on a side of the domain
  Faults faults;
  for (int n = 0; n < steps; ++n) {
    const StepStats stats = sim->step(sim->time() + 1);
    const auto now = surfaces.at(*sim);
    faults.crossings += crossings(strangers(scene, now));
    faults.outside += exact::points_outside(now, scene) - standing;
    faults.wound += all_windings(strangers(scene, now)) != windings;
    faults.most_contacts = std::max(faults.most_contacts, stats.contacts);
    for (std::size_t k = 0; k < scene.solids.size(); ++k)
      if (scene.solids[k].kind == SolidKind::elastic)
        faults.least_volume = std::min(faults.least_volume, least_volume_ratio(sim->solid_volume(k)));
  }
  return faults;
}

void check(const std::string& name, const Scene& scene, int steps) {
  const Faults faults = run(scene, steps);
  WARN(name << ": " << steps << " steps, up to " << faults.most_contacts << " contacts; " << faults.crossings
            << " crossings, " << faults.outside << " points outside, " << faults.wound
            << " states with one in another; least det F " << faults.least_volume);
  CHECK(faults.crossings == 0);
  CHECK(faults.outside == 0);
  CHECK(faults.wound == 0);
  CHECK(faults.least_volume > 0);
}

bool has_free_solids(const Scene& scene) {
  return std::any_of(scene.solids.begin(), scene.solids.end(),
                     [](const SolidSpec& s) { return s.kind == SolidKind::rigid || s.kind == SolidKind::elastic; });
}

// A scene on cells twice as large, if the domain allows it, with as many solids as the test has time for.
Scene coarse_scene(const std::filesystem::path& file) {
  Scene scene = read_scene(file);
  bool even = true;
  for (int a = 0; a < scene.dimension; ++a) even = even && scene.domain.cells[a] % 2 == 0;
  if (even) scene = read_scene(file, {{"domain.cell_size", fmt::format("{:.17g}", 2 * scene.domain.cell_size)}});
  const std::size_t most = scene.dimension == 2 ? 40 : 14;
  if (scene.solids.size() > most) scene.solids.resize(most);
  return scene;
}

using Dice = std::function<double(double low, double high)>;

// A tank of 1 m with a dam, an obstacle, and a swinging paddle.
Scene dam_and_paddle(int dim) {
  Scene s = test::box_scene(dim, dim == 2 ? 32 : 16);
  s.gravity = {0, -9.81, 0};
  LiquidRegionSpec dam;
  dam.shape.kind = "box";
  dam.shape.upper = {0.35, 0.7, 1};
  dam.shape.where = "test";
  s.liquid.regions.push_back(dam);
  const double middle = dim == 3 ? 0.5 : 0;
  s.solids.push_back(test::rigid_ball("obstacle", 0.09, {0.55, 0.12, middle}, 0));
  s.solids.back().kind = SolidKind::fixed;
  s.solids.back().friction = 0.2;
  s.solids.push_back(test::rigid_box("paddle", {0.05, 0.4, dim == 3 ? 0.6 : 0}, {0.9, 0.72, middle}, 0));
  s.solids.back().kind = SolidKind::kinematic;
  s.solids.back().motion.center = {0.9, 0.95, middle};
  s.solids.back().motion.degrees = "-30*sin(8*t)";
  return s;
}

// The n-th body, in a slot of its own: a box or a ball, in 3D also a mesh.
SolidSpec random_body(int dim, int n, const Dice& dice) {
  const int rows = dim == 3 ? 2 : 1;
  const Vec3 slot(0.14 + 0.2 * (n % 4), 0.37 + 0.22 * (n / 4 / rows), dim == 3 ? 0.25 + 0.5 * (n / 4 % rows) : 0);
  const double density = std::exp(dice(std::log(50), std::log(8000)));
  const Vec3 size(dice(0.06, 0.12), dice(0.06, 0.12), dim == 3 ? dice(0.06, 0.12) : 0);
  SolidSpec body = n % 2 == 0 ? test::rigid_box(fmt::format("box{}", n), size, slot, density, dice(0, 90))
                              : test::rigid_ball(fmt::format("ball{}", n), 0.5 * size[0], slot, density);
  body.rigid.velocity = {dice(-1, 1), dice(-3, 0), dim == 3 ? dice(-1, 1) : 0};
  body.rigid.angular_velocity = {0, 0, dice(-10, 10)};
  body.friction = dice(0, 0.6);
  if (dim == 3 && n % 4 == 0) {
    body.shape = ShapeSpec();
    body.shape.kind = "mesh";
    body.shape.file = SEICHE_SCENES "/meshes/duck.ply";
    body.shape.transform = {0.5, {{0, 1, 0}, dice(0, 360)}, slot};
    body.shape.where = "test";
  }
  return body;
}

Scene random_scene(int dim, unsigned seed) {
  std::mt19937 engine(seed);
  const Dice dice = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(engine); };
  Scene s = dam_and_paddle(dim);
  for (int n = 0; n < 8; ++n) s.solids.push_back(random_body(dim, n, dice));
  return s;
}

// A soft ball thrown among boxes into shallow water in front of a soft gate.
Scene soft_scene() {
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.3);
  SolidSpec ball = test::elastic_solid("ball", 600, {2e4, 0.45}, 0.05);
  ball.shape.kind = "sphere";
  ball.shape.center = {0.4, 0.6, 0};
  ball.shape.radius = 0.14;
  ball.rigid.velocity = {1, -4, 0};
  s.solids.push_back(ball);
  s.solids.push_back(test::elastic_box("gate", {0.72, 0, 0}, {0.78, 0.5, 0}, 1100, {5e4, 0.4}, 0.04));
  test::pin(s.solids.back(), {0.6, -0.1, 0}, {0.9, 0, 0});
  s.solids.push_back(test::rigid_box("low", {0.12, 0.12, 0}, {0.35, 0.32, 0}, 500));
  s.solids.push_back(test::rigid_box("high", {0.12, 0.12, 0}, {0.55, 0.33, 0}, 300, 20));
  for (auto& solid : s.solids) solid.friction = 0.3;
  return s;
}

}  // namespace

TEST_CASE("the exact tests see what intersects, what is outside and what has got into another") {
  const Scene scene = test::box_scene(2, 8);
  const auto square = [](double low, double high) {
    const SurfaceMesh mesh{
        {{low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}}, {}, {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}}};
    return PlacedSurface{mesh, Mobility::free};
  };
  CHECK(exact::intersections({square(0.1, 0.5), square(0.5, 0.6)}) > 0);  // they touch at a corner
  CHECK(exact::intersections({square(0.1, 0.5), square(std::nextafter(0.5, 1), 0.6)}) == 0);
  CHECK(exact::intersections({square(0.1, 0.5), square(0.2, 0.3)}) == 0);
  CHECK(exact::windings({square(0.1, 0.5), square(0.2, 0.3)}) == std::vector<int>{0, 1});
  CHECK(exact::points_outside({square(0.1, 1)}, scene) == 4);  // a corner twice
  CHECK(exact::points_outside({square(0.1, 0.999)}, scene) == 0);
}

TEST_CASE("no accepted state of the scenes has solids that intersect", "[long]") {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SEICHE_SCENES))
    if (entry.path().extension() == ".toml") files.insert(entry.path());
  for (const auto& file : files) {
    const Scene scene = coarse_scene(file);
    if (!has_free_solids(scene)) continue;
    DYNAMIC_SECTION(file.stem().string()) {
      const bool deforms = std::any_of(scene.solids.begin(), scene.solids.end(),
                                       [](const SolidSpec& solid) { return solid.kind == SolidKind::elastic; });
      check(file.stem().string(), scene,
            scene.dimension == 2 ? 100
            : deforms            ? 8
                                 : 50);  // a deforming 3D scene takes seconds a step
    }
  }
}

TEST_CASE("no accepted state of random dam breaks onto bodies has solids that intersect", "[long]") {
  for (int dim : {2, 3})
    for (unsigned seed = 1; seed <= 3; ++seed) DYNAMIC_SECTION(dim << "D, seed " << seed) {
        check(fmt::format("{}D, seed {}", dim, seed), random_scene(dim, seed), dim == 2 ? 150 : 80);
      }
}

TEST_CASE("no accepted state of a soft ball among boxes and a gate has solids that intersect or invert", "[elastic]") {
  check("2D, soft", soft_scene(), 60);  // 3D: scenes/soft_ball.toml, above
}

TEST_CASE("the least det F is seen anywhere in an element", "[elastic]") {
  VolumeFrame frame;
  frame.dimension = 2, frame.order = 2;
  frame.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
  frame.displacement.assign(6, Vec3::Zero());
  frame.elements = {0, 1, 2, 3, 4, 5};
  CHECK(least_volume_ratio(frame) == Approx(1));
  for (int a = 0; a < 6; ++a) frame.displacement[std::size_t(a)] = -0.5 * frame.rest[std::size_t(a)];
  CHECK(least_volume_ratio(frame) == Approx(0.25));
  frame.displacement.assign(6, Vec3::Zero());
  frame.displacement[3] = {-0.26, 0, 0};  // moves a side node past the quarter point
  CHECK(least_volume_ratio(frame) < 0);
}
