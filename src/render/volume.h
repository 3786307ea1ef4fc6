#pragma once
// Sampled fields of a frame, and intersection of rays with the liquid surface.
#include <array>
#include <vector>

#include "render/image.h"

namespace seiche::render {

// x(t) = origin + t direction; direction has length 1, so t is in metres.
struct Ray {
  Vec3f origin, direction;
  Vec3f at(float t) const { return origin + t * direction; }
};

struct Box {
  Vec3f lower{0, 0, 0}, upper{1, 1, 1};
  Vec3f center() const { return 0.5f * (lower + upper); }
  Vec3f size() const { return upper - lower; }
};

// Part t0 <= t <= t1 of a ray within a box, and the axes of the faces where it enters and leaves; t0 > t1: none.
struct Span {
  float t0 = 0, t1 = -1;
  int enter_axis = 0, leave_axis = 0;
  bool hits() const { return t0 < t1; }
};
Span clip(const Ray& ray, const Box& box);

// Values at cell centres lower + (i + 1/2) h, first axis fastest.
struct ScalarVolume {
  std::array<int, 3> cells{0, 0, 0};
  Vec3f lower{0, 0, 0};
  float h = 1;
  std::vector<float> values;

  float at(int i, int j, int k) const { return values[(std::size_t(k) * cells[1] + j) * cells[0] + i]; }
  // Trilinear between centres, constant outside of the outermost ones.
  float sample(const Vec3f& x) const;
  Vec3f gradient(const Vec3f& x) const;
  Box box() const;
};

// A level set (negative in the liquid) with flags for blocks of 8^3 cells that contain its zero contour.
class LiquidSurface {
 public:
  explicit LiquidSurface(ScalarVolume phi);
  const ScalarVolume& phi() const { return phi_; }
  bool inside(const Vec3f& x) const { return phi_.sample(x) < 0; }
  // First t in (t0, t1) at which phi has another sign than at t0; negative if there is none.
  float first_crossing(const Ray& ray, float t0, float t1) const;
  Vec3f normal(const Vec3f& x) const;  // out of the liquid, unit length

 private:
  bool near_surface(const std::array<int, 3>& block) const;
  float bisect(const Ray& ray, float same, float other, float sign) const;

  ScalarVolume phi_;
  std::array<int, 3> blocks_{0, 0, 0};
  std::vector<char> near_;
};

}  // namespace seiche::render
