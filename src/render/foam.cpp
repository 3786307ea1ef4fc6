#include "render/foam.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_range.h"

namespace seiche::render {
namespace {

constexpr float thickest = 0.85f;  // share of foam: what is below shines through

// Share of a value between two bounds (Ihmsen et al., eq. 1).
float between_bounds(float value, float low, float high) {
  return std::clamp((value - low) / (high - low), 0.0f, 1.0f);
}

// Mean curvature (sum of the principal ones, positive on crests) times h: the divergence of the normal.
float curvature(const ScalarVolume& phi, const std::array<int, 3>& cell) {
  float sum = 0;
  for (int a = 0; a < 3; ++a) {
    std::array<float, 2> slopes{0, 0};
    for (int side = 0; side < 2; ++side) {
      Vec3f x = phi.lower + phi.h * (Vec3f(float(cell[0]), float(cell[1]), float(cell[2])) + Vec3f::Constant(0.5f));
      x[a] += (side == 0 ? -0.75f : 0.75f) * phi.h;
      const Vec3f gradient = phi.gradient(x);
      slopes[std::size_t(side)] = gradient[a] / std::max(gradient.norm(), 1e-6f);
    }
    sum += (slopes[1] - slopes[0]) / 1.5f;
  }
  return sum;
}

// Mean over each cell and its neighbours, along one axis after the other.
void smooth_cells(ScalarVolume& volume) {
  const std::array<std::size_t, 3> stride{1, std::size_t(volume.cells[0]),
                                          std::size_t(volume.cells[0]) * volume.cells[1]};
  for (int a = 0; a < 3; ++a) {
    const std::vector<float> before = volume.values;
    for (std::size_t c = 0; c < before.size(); ++c) {
      const int i = int(c / stride[std::size_t(a)] % std::size_t(volume.cells[a]));
      const float low = i > 0 ? before[c - stride[std::size_t(a)]] : before[c];
      const float high = i + 1 < volume.cells[a] ? before[c + stride[std::size_t(a)]] : before[c];
      volume.values[c] = 0.25f * low + 0.5f * before[c] + 0.25f * high;
    }
  }
}

}  // namespace

ScalarVolume foam_of(const ScalarVolume& phi, const FaceVelocity& velocity, float fast, float amount) {
  ScalarVolume foam{phi.cells, phi.lower, phi.h, std::vector<float>(phi.values.size(), 0.0f)};
  if (velocity.cells != phi.cells) return foam;
  parallel_range(0, phi.cells[2], [&](int k) {
    for (int j = 0; j < phi.cells[1]; ++j) {
      for (int i = 0; i < phi.cells[0]; ++i) {
        const std::array<int, 3> cell{i, j, k};
        if (!(std::abs(phi.at(i, j, k)) < 2 * phi.h)) continue;
        const Vec3f u(velocity.at_center(cell, 0), velocity.at_center(cell, 1), velocity.at_center(cell, 2));
        const float energy = between_bounds(u.squaredNorm() / (fast * fast), 0.15f, 1.0f);
        if (energy <= 0) continue;
        const float crest = between_bounds(std::abs(curvature(phi, cell)), 0.25f, 1.2f);
        foam.values[(std::size_t(k) * phi.cells[1] + j) * phi.cells[0] + i] = amount * energy * crest;
      }
    }
  });
  smooth_cells(foam);
  for (float& value : foam.values) value = std::min(1.5f * value, thickest);
  return foam;
}

}  // namespace seiche::render
