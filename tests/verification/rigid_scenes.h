#pragma once
// Rigid bodies for the verification tests, and measures of their motion.
#include "base/fluid_spec.h"
#include "base/solid_spec.h"
#include "scenes.h"

namespace seiche::test {

inline constexpr double pi = 3.14159265358979323846;

// A box about its center, turned by `degrees` about z.
inline SolidSpec rigid_box(const std::string& name, const Vec3& size, const Vec3& center, double density,
                           double degrees = 0) {
  SolidSpec s;
  s.name = name;
  s.kind = SolidKind::rigid;
  s.shape.kind = "box";
  s.shape.upper = 0.5 * size;
  s.shape.lower = -0.5 * size;
  s.shape.transform.rotate = {{0, 0, 1}, degrees};
  s.shape.transform.translate = center;
  s.shape.where = "test";
  s.rigid.density = density;
  return s;
}

inline SolidSpec rigid_ball(const std::string& name, double radius, const Vec3& center, double density) {
  SolidSpec s;
  s.name = name;
  s.kind = SolidKind::rigid;
  s.shape.kind = "sphere";
  s.shape.center = center;
  s.shape.radius = radius;
  s.shape.where = "test";
  s.rigid.density = density;
  return s;
}

// Liquid below `level` from wall to wall.
inline void add_pool(Scene& s, double level) {
  LiquidRegionSpec pool;
  pool.shape.kind = "box";
  pool.shape.upper = s.domain.upper;
  pool.shape.upper[1] = level;
  pool.shape.where = "test";
  s.liquid.regions.push_back(pool);
}

// Rotation about z, degrees, (-180, 180].
inline double degrees_about_z(const SolidState& s) {
  return 2 * std::atan2(s.orientation[3], s.orientation[0]) * 180 / pi;
}

// Windowed mean of an oscillating quantity: the weight sin^2 over the time of observation removes almost all of
// oscillations with more than two periods.
struct SettledMean {
  double from, until;
  double sum = 0, weights = 0;
  void add(double t, double dt, double value) {
    if (t < from || t > until) return;
    const double w = dt * std::pow(std::sin(pi * (t - from) / (until - from)), 2);
    sum += w * value, weights += w;
  }
  double value() const { return sum / weights; }
};

}  // namespace seiche::test
