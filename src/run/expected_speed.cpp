#include "run/expected_speed.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "base/expression.h"
#include "base/gravity.h"
#include "base/scene.h"

namespace seiche {
namespace {

constexpr int most_looks = 200;  // times within a run at which prescribed speeds are looked at

double largest_distance(const SurfaceMesh& surface, const MotionSpec& motion) {
  const Vec3 axis = motion.axis.normalized();
  double largest = 0;
  for (const Vec3& x : surface.points) largest = std::max(largest, (x - motion.center).cross(axis).norm());
  return largest;
}

double speed_of_motion(const MotionSpec& motion, const SurfaceMesh& surface, double end) {
  const VectorExpression way(motion.translate);
  const Expression degrees(motion.degrees);
  const double span = end / most_looks, soon = 1e-3 * span, reach = largest_distance(surface, motion);
  double largest = 0;
  for (int n = 0; n < most_looks; ++n) {
    const double t = n * span;
    const double turn = std::abs(degrees(Vec3::Zero(), t + soon) - degrees(Vec3::Zero(), t)) * M_PI / 180;
    largest = std::max(largest, ((way(Vec3::Zero(), t + soon) - way(Vec3::Zero(), t)).norm() + turn * reach) / soon);
  }
  return largest;
}

double speed_of_formula(const VectorFormula& velocity, const Vec3& x, double end) {
  const VectorExpression v(velocity);
  double largest = 0;
  for (int n = 0; n <= most_looks; ++n) largest = std::max(largest, v(x, end * n / most_looks).norm());
  return largest;
}

// Points of a side on a grid.
std::vector<Vec3> points_of_side(const Scene& scene, int axis, int side) {
  constexpr int count = 24;  // along each axis
  std::vector<Vec3> points;
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const Vec3 size = scene.domain.upper - scene.domain.lower;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      Vec3 x = scene.domain.lower;
      x[axis] += side * size[axis], x[b] += (i + 0.5) / count * size[b], x[c] += (j + 0.5) / count * size[c];
      points.push_back(x);
    }
  return points;
}

bool is_thick(const Scene& scene) {
  constexpr double thick = 1;  // Pa s: liquid that falls more slowly than freely
  const LiquidSpec& liquid = scene.liquid;
  return !liquid.rheology.model.empty() || Expression(liquid.viscosity)(Vec3::Zero(), 0) >= thick;
}

}  // namespace

double speed_of_kinematic_solids(const Scene& scene, const std::vector<SurfaceMesh>& at_start) {
  double largest = 0;
  for (std::size_t k = 0; k < scene.solids.size() && scene.time.end > 0; ++k)
    if (scene.solids[k].kind == SolidKind::kinematic)
      largest = std::max(largest, speed_of_motion(scene.solids[k].motion, at_start[k], scene.time.end));
  return largest;
}

double speed_of_feeds(const Scene& scene) {
  const Vec3 g = Gravity(scene.gravity).at(0), middle = 0.5 * (scene.domain.lower + scene.domain.upper);
  const bool falls = !is_thick(scene);
  const Vec3 floor = (g.array() > 0).select(scene.domain.upper, scene.domain.lower);
  double largest = 0;
  const auto note = [&](double speed, const Vec3& at) {
    if (speed > 0)
      largest = std::max(largest, std::sqrt(speed * speed + (falls ? 2 * std::max(0.0, g.dot(floor - at)) : 0.0)));
  };
  for (int a = 0; a < scene.dimension; ++a)
    for (const int side : {0, 1}) {
      const SideSpec& spec = scene.domain.sides[std::size_t(a)][std::size_t(side)];
      if (spec.type != SideType::inflow) continue;
      for (const Vec3& at : points_of_side(scene, a, side))
        note(speed_of_formula(spec.velocity, at, scene.time.end), at);
    }
  for (const auto& source : scene.liquid.sources)
    note(speed_of_formula(source.velocity, middle, scene.time.end), middle);
  return largest;
}

}  // namespace seiche
