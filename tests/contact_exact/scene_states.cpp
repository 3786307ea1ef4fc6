// No accepted state of the program's own steps has surfaces that intersect: the scenes of scenes/ with rigid or elastic
// solids, and random dam breaks onto boxes, balls and meshes between obstacles and a paddle.
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <random>
#include <set>

#include "exact_intersections.h"
#include "io/scene_reader.h"
#include "rigid_scenes.h"
#include "solid/body.h"

using namespace seiche;
using exact::Mobility;
using exact::PlacedSurface;

namespace {

// The surfaces of a simulation's solids: of rigid and elastic ones where it says they are, of others where their motion
// puts them.
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
};

Faults run(const Scene& scene, int steps) {
  const auto sim = make_simulation(scene, Communicator());
  const Surfaces surfaces(scene);
  const std::vector<int> windings = exact::windings(surfaces.at(*sim));
  Faults faults;
  for (int n = 0; n < steps; ++n) {
    const StepStats stats = sim->step(sim->time() + 1);
    const auto now = surfaces.at(*sim);
    faults.crossings += exact::intersections(now);
    faults.outside += exact::points_outside(now, scene);
    faults.wound += exact::windings(now) != windings;
    faults.most_contacts = std::max(faults.most_contacts, stats.contacts);
  }
  return faults;
}

void check(const std::string& name, const Scene& scene, int steps) {
  const Faults faults = run(scene, steps);
  WARN(name << ": " << steps << " steps, up to " << faults.most_contacts << " contacts; " << faults.crossings
            << " crossings, " << faults.outside << " points outside, " << faults.wound
            << " states with one in another");
  CHECK(faults.crossings == 0);
  CHECK(faults.outside == 0);
  CHECK(faults.wound == 0);
}

bool has_free_solids(const Scene& scene) {
  return std::any_of(scene.solids.begin(), scene.solids.end(),
                     [](const SolidSpec& s) { return s.kind == SolidKind::rigid || s.kind == SolidKind::elastic; });
}

// A scene on cells twice as large, where the domain takes them, with as many solids as this test has time for.
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

// A tank of 1 m with a dam, an obstacle, and a paddle that swings.
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

// The n-th body, in a slot of its own: a box, a ball, in 3D also a mesh.
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

}  // namespace

TEST_CASE("the exact tests see what intersects, what is outside and what has got into another") {
  const Scene scene = test::box_scene(2, 8);
  const auto square = [](double low, double high) {
    const SurfaceMesh mesh{
        {{low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}}, {}, {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}}};
    return PlacedSurface{mesh, Mobility::free};
  };
  CHECK(exact::intersections({square(0.1, 0.5), square(0.5, 0.6)}) > 0);  // they touch in a corner
  CHECK(exact::intersections({square(0.1, 0.5), square(std::nextafter(0.5, 1), 0.6)}) == 0);
  CHECK(exact::intersections({square(0.1, 0.5), square(0.2, 0.3)}) == 0);
  CHECK(exact::windings({square(0.1, 0.5), square(0.2, 0.3)}) == std::vector<int>{0, 1});
  CHECK(exact::points_outside({square(0.1, 1)}, scene) == 4);  // a corner twice
  CHECK(exact::points_outside({square(0.1, 0.999)}, scene) == 0);
}

TEST_CASE("no accepted state of the scenes has solids that intersect") {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SEICHE_SCENES))
    if (entry.path().extension() == ".toml") files.insert(entry.path());
  for (const auto& file : files) {
    const Scene scene = coarse_scene(file);
    if (!has_free_solids(scene)) continue;
    DYNAMIC_SECTION(file.stem().string()) {
      check(file.stem().string(), scene, scene.dimension == 2 ? 100 : 50);
    }
  }
}

TEST_CASE("no accepted state of random dam breaks onto bodies has solids that intersect") {
  for (int dim : {2, 3})
    for (unsigned seed = 1; seed <= 3; ++seed) DYNAMIC_SECTION(dim << "D, seed " << seed) {
        check(fmt::format("{}D, seed {}", dim, seed), random_scene(dim, seed), dim == 2 ? 150 : 80);
      }
}
