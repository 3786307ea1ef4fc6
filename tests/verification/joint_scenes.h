#pragma once
// Jointed bodies for the verification tests.
#include "rigid_scenes.h"

namespace seiche::test {

inline JointSpec joint(const std::string& name, JointKind kind, const std::string& first, const std::string& second,
                       const Vec3& at) {
  JointSpec j;
  j.name = name;
  j.kind = kind;
  j.between = {first, second};
  j.at = at;
  j.where = "test";
  return j;
}

inline JointSpec hinge(const std::string& name, const std::string& first, const std::string& second, const Vec3& at,
                       const Vec3& axis = Vec3::Zero()) {
  JointSpec j = joint(name, JointKind::hinge, first, second, at);
  j.axis = axis;
  return j;
}

// A slab in the plane with the inertia of a thin bar of this length: thicker than a cell, so that steps go by halves.
inline SolidSpec bar_like(const std::string& name, const Vec3& from, const Vec3& to, double mass, double thickness) {
  const double length = (to - from).norm(), slab = std::sqrt(length * length - thickness * thickness);
  const double degrees = std::atan2(to[1] - from[1], to[0] - from[0]) * 180 / pi;
  return rigid_box(name, {slab, thickness, 0}, 0.5 * (from + to), mass / (slab * thickness), degrees);
}

// A box about the origin, dry or not, in which things swing.
inline Scene swing_scene(int dimension, double half_width, double cell, double gravity = 9.81) {
  const int cells = int(std::ceil(2 * half_width / cell));
  Scene s = box_scene(dimension, cells, 2 * half_width);
  for (int a = 0; a < dimension; ++a) s.domain.lower[a] -= half_width, s.domain.upper[a] -= half_width;
  s.gravity = Vec3(0, -gravity, 0);
  s.time.frame_rate = 0.1;  // no frame cuts steps short
  return s;
}

// Two bars of a metre, let go from the horizontal.
inline Scene double_pendulum() {
  Scene s = swing_scene(2, 2.6, 0.2);
  s.solids = {bar_like("upper", {0, 0, 0}, {1, 0, 0}, 1, 0.3), bar_like("lower", {1, 0, 0}, {2, 0, 0}, 1, 0.3)};
  s.joints = {hinge("pin", "upper", "world", {0, 0, 0}), hinge("elbow", "lower", "upper", {1, 0, 0})};
  return s;
}

// Calls look(simulation) at the start and after each step.
template <class Look>
void run_steps(const Scene& s, double end, const Look& look) {
  const auto sim = make_simulation(s, Communicator());
  look(*sim);
  while (sim->time() < end * (1 - 1e-12)) {
    (void)sim->step(end);
    look(*sim);
  }
}

// Mechanical energy, J.
inline double energy_of(const StepStats& s) {
  return s.kinetic_energy + s.potential_energy + s.elastic_energy;
}

// Time at which y goes through zero between samples 1 and 2 of four: the cubic through them, inverted.
inline double crossing(const std::array<double, 4>& t, const std::array<double, 4>& y) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    double part = t[k];
    for (std::size_t m = 0; m < 4; ++m)
      if (m != k) part *= -y[m] / (y[k] - y[m]);
    sum += part;
  }
  return sum;
}

// Collects the crossings of a signal.
class Crossings {
 public:
  void add(double t, double y) {
    std::rotate(t_.begin(), t_.begin() + 1, t_.end());
    std::rotate(y_.begin(), y_.begin() + 1, y_.end());
    t_[3] = t, y_[3] = y;
    if (++count_ >= 4 && y_[1] * y_[2] < 0) times.push_back(crossing(t_, y_));
  }
  std::vector<double> times;

 private:
  std::array<double, 4> t_{}, y_{};
  int count_ = 0;
};

}  // namespace seiche::test
