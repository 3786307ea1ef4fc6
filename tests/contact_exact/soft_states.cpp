// No state of soft bodies in violent motion has surfaces that intersect themselves or each other.
#include "exact_intersections.h"
#include "unit/solid/soft_motions.h"

using namespace seiche;
using namespace seiche::testing;

namespace {

template <int Dim>
int intersections(const SoftWorld<Dim>& world) {
  std::vector<exact::PlacedSurface> surfaces;
  for (const auto& b : world.rigid) {
    const bool free = b.contact.control == BodyControl::free;
    surfaces.push_back({b.contact.surface, free ? exact::Mobility::free : exact::Mobility::prescribed});
    for (Vec3& x : surfaces.back().mesh.points) x = b.pose.apply(x);
  }
  for (const auto& s : world.soft) {
    ElasticSurface surface = surface_of<Dim>(s.body.mesh);
    move_surface<Dim>(surface, s.body.mesh, s.state.u);
    surfaces.push_back({surface.facets, exact::Mobility::deformable});
  }
  return exact::intersections(surfaces);
}

// Points below an inclined wall.
template <int Dim>
int outside(const SoftWorld<Dim>& world) {
  int found = 0;
  for (const auto& s : world.soft)
    for (size_t n = 0; n < s.body.mesh.nodes.size(); ++n) {
      const Vec<Dim> x = s.body.mesh.nodes[n] + s.state.u.template segment<Dim>(Dim * Eigen::Index(n));
      for (const auto& w : world.walls) found += (extend<Dim>(x) - w.point).dot(w.normal) <= 0;
    }
  return found;
}

// Soft balls and bars and rigid boxes dropped onto each other between walls.
template <int Dim>
SoftWorld<Dim> heap() {
  SoftWorld<Dim> world;
  world.gravity = Vec3(0, -9.81, 0);
  world.options.acceleration = 100;
  world.options.creep_speed = 0.01;  // far lower creep speeds cost violent piles many iterations
  world.walls = {{Vec3::Zero(), Vec3::UnitY()},
                 {Vec3(-0.2, 0, 0), Vec3::UnitX()},
                 {Vec3(0.2, 0, 0), -Vec3::UnitX()},
                 {Vec3(0, 0, -0.2), Vec3::UnitZ()},
                 {Vec3(0, 0, 0.2), -Vec3::UnitZ()}};
  if (Dim == 2) world.walls.resize(3);
  for (int i = 0; i < 2; ++i) {
    const Vec3 sides(0.12, 0.08, 0.1);
    const double mass = 1000 * sides.head<Dim>().prod();
    auto& b = world.add_rigid(contact_cases::box<Dim>(sides), Vec3(0.03 - 0.05 * i, 0.3 + 0.4 * i, 0), mass,
                              mass / 12 * Vec3(0.0164, 0.0244, 0.0208));
    b.velocity[1] = -3;
    b.contact.friction = 0.3;
  }
  for (int i = 0; i < 3; ++i) {
    const Vec<Dim> center = Vec<Dim>::Unit(1) * (0.12 + 0.37 * i) + Vec<Dim>::Unit(0) * 0.02 * i;
    auto mesh = i == 1 ? box_mesh<Dim>(center - Vec<Dim>::Constant(0.03), center + Vec<Dim>::Constant(0.03),
                                       IVec<Dim>::Constant(2), 2)
                       : ball_mesh<Dim>(0.09, center, Dim == 2 ? 4 : 2, 2);
    auto& s = world.add(std::move(mesh), 1000, i == 1 ? 1e4 : 5e4, 0.4);
    for (int k = 0; k < s.body.size(); ++k) s.state.v[k] = k % Dim == 1 ? -3 : 0;
    s.friction = 0.4;
  }
  return world;
}

template <int Dim>
SurfaceMesh folded_sheet(double lift) {
  auto surface = surface_of<Dim>(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(4), 1));
  for (Vec3& x : surface.facets.points)
    if (x[0] > 0.7 && x[1] > 0.9 && (Dim == 2 || x[2] > 0.4)) x[1] = lift;
  return surface.facets;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the exact test sees a surface that crosses itself", "", ((int Dim), Dim), 2, 3) {
  CHECK(exact::intersections({{folded_sheet<Dim>(0.9), exact::Mobility::deformable}}) == 0);
  CHECK(exact::intersections({{folded_sheet<Dim>(-0.1), exact::Mobility::deformable}}) > 0);
  CHECK(exact::intersections({{folded_sheet<Dim>(-0.1), exact::Mobility::free}}) == 0);
}

TEMPLATE_TEST_CASE_SIG("a soft ball thrown at a wall never intersects", "", ((int Dim), Dim), 2, 3) {
  for (double E : {1e2, 1e5, 1e9}) {
    auto world = ball_at_wall<Dim>(E, Dim == 3 && E < 1e3 ? 0.5 : 5, Dim == 2 ? 6 : 2);
    for (int n = 0; n < (Dim == 2 ? 40 : 15); ++n) {
      world.step(0.002);
      REQUIRE(intersections(world) == 0);
      REQUIRE(outside(world) == 0);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("a strip folded onto itself never intersects", "[long]", ((int Dim), Dim), 2, 3) {
  FoldedStrip<Dim> strip;
  for (int n = 0; n < 80; ++n) {
    strip.fold();
    REQUIRE(intersections(strip.world) == 0);
  }
  CHECK(strip.world.report.active > 3);
}

TEMPLATE_TEST_CASE_SIG("a heap of soft and rigid bodies never intersects", "[long]", ((int Dim), Dim), 2, 3) {
  SoftWorld<Dim> world = heap<Dim>();
  REQUIRE(intersections(world) == 0);
  int active = 0, most = 0;
  for (int n = 0; n < (Dim == 2 ? 60 : 15); ++n) {
    world.step(0.01);
    active = std::max(active, world.report.active);
    most = std::max(most, world.report.newton_iterations);
    REQUIRE(intersections(world) == 0);
    REQUIRE(outside(world) == 0);
  }
  WARN(Dim << "D heap: up to " << active << " pairs, " << world.newton_iterations << " iterations, at most " << most
           << " a step");
  CHECK(active > 10);
}
