#pragma once
// Waves that pass a side of the domain: the flow that enters with them, and how the side lets out those that come.
#include "base/vec.h"
#include "base/water_waves.h"

namespace seiche {

struct DomainSpec;
struct SideWavesSpec;

class WaveSide {
 public:
  // `side`: 0 lower, 1 upper, across `axis`. Gravity (m/s^2) lies along another axis.
  WaveSide(const SideWavesSpec& spec, const DomainSpec& domain, int axis, int side, const Vec3& gravity);

  // Component of the velocity of the waves that enter, at x and t, m/s.
  double velocity(int component, const Vec3& x, double t) const;
  // Their level above that of rest, m.
  double elevation(const Vec3& x, double t) const;
  // Speed out of the domain at x by which an excess of the level is let out, per metre of it, 1/s:
  //   w cosh k(z + h)/sinh kh,  that of a wave of the period that leaves; constant above the level of rest.
  double outlet(const Vec3& x) const;
  // x above the level of rest, m.
  double above_rest(const Vec3& x) const { return up_ * (x[vertical_] - level_); }

  bool absorbs() const { return absorbs_; }
  int vertical() const { return vertical_; }  // axis

 private:
  double growth(double t) const;

  WaveTrain train_;
  WaveTrain leaving_;  // of one metre
  Vec3 direction_, origin_;
  double ramp_, level_, up_;
  int vertical_;
  bool absorbs_;
};

}  // namespace seiche
