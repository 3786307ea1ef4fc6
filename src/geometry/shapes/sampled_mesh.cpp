#include "geometry/shapes/sampled_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh/inside.h"

namespace seiche {
namespace {

constexpr int shift = 3, edge = 1 << shift, mask = edge - 1;  // edge: voxels along a block
constexpr double slack = 1e-9;                                // relative, above round-off

Vec3 position(const std::array<std::int64_t, 3>& block, double voxel, const Vec3& within) {
  return voxel * (edge * Vec3(double(block[0]), double(block[1]), double(block[2])) + within);
}

// Position in a block of a voxel's lower neighbour along the first axis that has one.
int neighbour_below(int site) {
  if (site & mask) return site - 1;
  if (site & (mask << shift)) return site - edge;
  return site - edge * edge;
}

}  // namespace

std::size_t SampledMesh::Hash::operator()(const Index& i) const {
  std::uint64_t hash = 0;
  for (const std::int64_t n : i) hash = (hash ^ std::uint64_t(n)) * 0x9E3779B97F4A7C15u;
  return std::size_t(hash ^ (hash >> 32));
}

SampledMesh::SampledMesh(SurfaceMesh mesh, double voxel, double half_width)
    : mesh_(std::move(mesh)), nearest_(mesh_), voxel_(voxel), band_(half_width * voxel) {
  lower_ = upper_ = mesh_.points.front();
  for (const Vec3& p : mesh_.points) {
    lower_ = lower_.cwiseMin(p);
    upper_ = upper_.cwiseMax(p);
  }
  lower_.array() -= band_ + 2 * voxel;
  upper_.array() += band_ + 2 * voxel;
}

double SampledMesh::operator()(const Vec3& x) const {
  if ((x.array() < lower_.array()).any() || (x.array() > upper_.array()).any()) return band_;
  const Vec3 index = x / voxel_, floor = index.array().floor(), t = index - floor;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Index voxel;
    double weight = 1;
    for (int a = 0; a < 3; ++a) {
      const int step = (corner >> a) & 1;
      voxel[a] = std::int64_t(floor[a]) + step;
      weight *= step ? t[a] : 1 - t[a];
    }
    if (weight > 0) sum += weight * at(voxel);
  }
  return sum;
}

double SampledMesh::at(const Index& voxel) const {
  const Index index{voxel[0] >> shift, voxel[1] >> shift, voxel[2] >> shift};
  if (!last_ || index != last_index_) {
    auto found = blocks_.find(index);
    if (found == blocks_.end()) found = blocks_.emplace(index, make_block(index)).first;
    last_ = &found->second;
    last_index_ = index;
  }
  if (last_->size() == 1) return last_->front();
  return (*last_)[std::size_t((voxel[0] & mask) + edge * ((voxel[1] & mask) + edge * (voxel[2] & mask)))];
}

// A block is uniform if its middle is farther from the surface than its half diagonal plus the band.
SampledMesh::Block SampledMesh::make_block(const Index& block) const {
  const double half = 0.5 * mask;
  const Vec3 middle = position(block, voxel_, Vec3::Constant(half));
  const double reach = band_ + std::sqrt(3.0) * half * voxel_;
  if (nearest_.distance(middle, reach) < reach) return fill_block(block);
  return {float(mesh::contains(nearest_, middle) ? -band_ : band_)};
}

// Distances of neighbours differ by at most one voxel, which bounds the search. A voxel lies on the same side as its
// neighbour if the neighbour is farther than one voxel from the surface.
SampledMesh::Block SampledMesh::fill_block(const Index& block) const {
  constexpr int size = edge * edge * edge;
  const double step = voxel_ * (1 + slack);
  std::array<double, size> distance;
  std::array<bool, size> inside;
  Block values(size);
  for (int site = 0; site < size; ++site) {
    const Vec3 x = position(block, voxel_, Vec3(site & mask, (site >> shift) & mask, site >> 2 * shift));
    const int below = site > 0 ? neighbour_below(site) : 0;
    distance[site] = nearest_.distance(x, site > 0 ? std::min(band_, distance[below] + step) : band_);
    inside[site] = site > 0 && distance[below] > step ? inside[below] : mesh::contains(nearest_, x);
    values[site] = float(inside[site] ? -distance[site] : distance[site]);
  }
  return values;
}

}  // namespace seiche
