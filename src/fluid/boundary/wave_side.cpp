#include "fluid/boundary/wave_side.h"

#include <cmath>

#include "base/domain_spec.h"

namespace seiche {
namespace {

// A linear wave of 1 m of amplitude, with its crest at s = 0, t = 0.
WaveTrain unit_wave(double period, double depth, double gravity) {
  const double w = 2 * M_PI / period, k = wave_number(w, gravity, depth);
  WaveTrain train;
  train.modes = {{1, w / std::tanh(k * depth), k, w, 0}};
  train.depth = depth;
  return train;
}

int axis_along(const Vec3& v) {
  Eigen::Index axis = 1;
  v.cwiseAbs().maxCoeff(&axis);
  return int(axis);
}

}  // namespace

WaveSide::WaveSide(const SideWavesSpec& spec, const DomainSpec& domain, int axis, int side, const Vec3& gravity)
    : train_(wave_train(spec, gravity.norm())),
      leaving_(unit_wave(spec.period, spec.depth, gravity.norm())),
      direction_(spec.towards ? spec.towards->normalized() : Vec3((side == 0 ? 1 : -1) * Vec3::Unit(axis))),
      origin_(domain.lower),
      ramp_(spec.ramp.value_or(2 * spec.period)),
      vertical_(axis_along(gravity)),
      absorbs_(spec.absorbs) {
  up_ = gravity[vertical_] < 0 ? 1 : -1;
  const double bottom = (up_ > 0 ? domain.lower : domain.upper)[vertical_];
  level_ = spec.level.value_or(bottom + up_ * spec.depth);
}

double WaveSide::growth(double t) const {
  return t < ramp_ ? 0.5 - 0.5 * std::cos(M_PI * t / ramp_) : 1;
}

// The drift of waves grows as the square of their height.
double WaveSide::velocity(int component, const Vec3& x, double t) const {
  const double s = direction_.dot(x - origin_), z = above_rest(x), r = growth(t);
  if (r == 0) return 0;
  if (component == vertical_) return up_ * r * train_.upward(s, z, t);
  if (direction_[component] == 0) return 0;
  return direction_[component] * (r * train_.along(s, z, t) + r * r * train_.current);
}

double WaveSide::elevation(const Vec3& x, double t) const {
  return growth(t) * train_.elevation(direction_.dot(x - origin_), t);
}

double WaveSide::outlet(const Vec3& x) const {
  return leaving_.along(0, above_rest(x), 0);
}

}  // namespace seiche
