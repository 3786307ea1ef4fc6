#include "render/volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche::render {
namespace {

constexpr int block_cells = 8;

// Interpolation along an axis: the index of the low sample, and the weight of the high one.
struct Weight {
  int low, high;
  float share;
};

inline Weight weigh(float index, int cells) {
  const float clamped = std::clamp(index, 0.0f, float(cells - 1));
  const int low = std::min(int(clamped), cells - 1), high = std::min(low + 1, cells - 1);
  return {low, high, clamped - float(low)};
}

}  // namespace

Span clip(const Ray& ray, const Box& box) {
  Span span{0, std::numeric_limits<float>::max(), 0, 0};
  for (int a = 0; a < 3; ++a) {
    const float inverse = 1 / ray.direction[a];
    float near = (box.lower[a] - ray.origin[a]) * inverse, far = (box.upper[a] - ray.origin[a]) * inverse;
    if (ray.direction[a] == 0) {
      const bool within = ray.origin[a] >= box.lower[a] && ray.origin[a] <= box.upper[a];
      near = within ? -span.t1 : span.t1, far = within ? std::numeric_limits<float>::max() : -1;
    }
    if (near > far) std::swap(near, far);
    if (near > span.t0) span.t0 = near, span.enter_axis = a;
    if (far < span.t1) span.t1 = far, span.leave_axis = a;
  }
  return span;
}

float ScalarVolume::sample(const Vec3f& x) const {
  const Vec3f index = (x - lower) / h - Vec3f::Constant(0.5f);
  const Weight wx = weigh(index[0], cells[0]), wy = weigh(index[1], cells[1]), wz = weigh(index[2], cells[2]);
  const std::size_t rows[4] = {
      (std::size_t(wz.low) * cells[1] + wy.low) * cells[0], (std::size_t(wz.low) * cells[1] + wy.high) * cells[0],
      (std::size_t(wz.high) * cells[1] + wy.low) * cells[0], (std::size_t(wz.high) * cells[1] + wy.high) * cells[0]};
  float along[4];
  for (int r = 0; r < 4; ++r) {
    const float low = values[rows[r] + wx.low], high = values[rows[r] + wx.high];
    along[r] = low + wx.share * (high - low);
  }
  const float low = along[0] + wy.share * (along[1] - along[0]), high = along[2] + wy.share * (along[3] - along[2]);
  return low + wz.share * (high - low);
}

Vec3f ScalarVolume::gradient(const Vec3f& x) const {
  Vec3f g;
  for (int a = 0; a < 3; ++a) {
    const Vec3f step = 0.75f * h * Vec3f::Unit(a);
    g[a] = (sample(x + step) - sample(x - step)) / (1.5f * h);
  }
  return g;
}

Box ScalarVolume::box() const {
  return {lower, lower + h * Vec3f(float(cells[0]), float(cells[1]), float(cells[2]))};
}

LiquidSurface::LiquidSurface(ScalarVolume phi) : phi_(std::move(phi)) {
  for (int a = 0; a < 3; ++a) blocks_[a] = (phi_.cells[a] + block_cells - 1) / block_cells;
  near_.resize(std::size_t(blocks_[0]) * blocks_[1] * blocks_[2]);
  for (std::size_t b = 0; b < near_.size(); ++b) {
    near_[b] =
        near_surface({int(b) % blocks_[0], int(b) / blocks_[0] % blocks_[1], int(b) / (blocks_[0] * blocks_[1])});
  }
}

// True if both signs occur among the samples for interpolation within the block.
bool LiquidSurface::near_surface(const std::array<int, 3>& block) const {
  std::array<int, 3> low, high;
  for (int a = 0; a < 3; ++a) {
    low[a] = std::max(0, block[a] * block_cells - 1);
    high[a] = std::min(phi_.cells[a], (block[a] + 1) * block_cells + 1);
  }
  bool negative = false, positive = false;
  for (int k = low[2]; k < high[2]; ++k) {
    for (int j = low[1]; j < high[1] && !(negative && positive); ++j) {
      for (int i = low[0]; i < high[0]; ++i) (phi_.at(i, j, k) < 0 ? negative : positive) = true;
    }
  }
  return negative && positive;
}

float LiquidSurface::bisect(const Ray& ray, float same, float other, float sign) const {
  for (int i = 0; i < 10; ++i) {  // the bracket is at most 3 h and ends below h/300
    const float middle = 0.5f * (same + other);
    (sign * phi_.sample(ray.at(middle)) > 0 ? same : other) = middle;
  }
  return 0.5f * (same + other);
}

float LiquidSurface::first_crossing(const Ray& ray, float t0, float t1) const {
  const float h = phi_.h, nudge = 1e-3f * h;
  const float sign = inside(ray.at(t0)) ? -1.0f : 1.0f;
  const Vec3f inverse = ray.direction.cwiseInverse();
  float last = t0;
  for (float t = t0; t < t1;) {
    const Vec3f x = ray.at(t), block_index = (x - phi_.lower) / (h * block_cells);
    std::array<int, 3> block;
    float leave = std::numeric_limits<float>::max();
    for (int a = 0; a < 3; ++a) {
      block[a] = std::clamp(int(std::floor(block_index[a])), 0, blocks_[a] - 1);
      const float face = phi_.lower[a] + h * float(block_cells * (block[a] + (inverse[a] > 0 ? 1 : 0)));
      if (ray.direction[a] != 0) leave = std::min(leave, (face - ray.origin[a]) * inverse[a]);
    }
    if (!near_[(std::size_t(block[2]) * blocks_[1] + block[1]) * blocks_[0] + block[0]]) {
      last = t;
      t = std::max(leave, t) + nudge;
      continue;
    }
    const float distance = sign * phi_.sample(x);
    if (distance <= 0) return bisect(ray, last, t, sign);
    last = t;
    t += std::max(0.9f * distance, 0.3f * h);
    if (t >= t1 && sign * phi_.sample(ray.at(t1)) <= 0) return bisect(ray, last, t1, sign);
  }
  return -1;
}

Vec3f LiquidSurface::normal(const Vec3f& x) const {
  const Vec3f g = phi_.gradient(x);
  const float length = g.norm();
  return length > 1e-6f ? Vec3f(g / length) : Vec3f::UnitY();
}

}  // namespace seiche::render
