#include "levelset/sampled_distance.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace seiche::vdb {
namespace {

class WithinDomain : public SampledDistance {
 public:
  WithinDomain(std::unique_ptr<SampledDistance> inner, const Frame& frame, const std::array<int, 3>& cells)
      : inner_(std::move(inner)),
        lower_(frame.lower),
        half_(Vec3::Constant(frame.cell_size / 2)),
        upper_(lower_ + frame.cell_size * Vec3(cells[0], cells[1], cells[2])),
        dimension_(frame.dimension) {}

  double operator()(const Vec3& x) const override {
    const double inside = (*inner_)(x.cwiseMin(upper_ - half_).cwiseMax(lower_ + half_));
    const double outside = (lower_ - x).cwiseMax(x - upper_).cwiseMax(0.0).head(dimension_).norm();
    return outside > 0 ? std::max(inside, outside) : inside;
  }

 private:
  std::unique_ptr<SampledDistance> inner_;
  Vec3 lower_, half_, upper_;
  int dimension_;
};

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 p = mesh.points[t[0]];
    sum += 0.5 * (mesh.points[t[1]] - p).cross(mesh.points[t[2]] - p).norm();
  }
  return sum;
}

// Solids, less their cavities, plus the solids in those, ...
class NestedDistance : public SampledDistance {
 public:
  explicit NestedDistance(std::vector<std::unique_ptr<SampledDistance>> levels) : levels_(std::move(levels)) {}

  double operator()(const Vec3& x) const override {
    double phi = (*levels_.front())(x);
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      const double here = (*levels_[level])(x);
      phi = level % 2 ? std::max(phi, -here) : std::min(phi, here);
    }
    return phi;
  }

 private:
  std::vector<std::unique_ptr<SampledDistance>> levels_;
};

}  // namespace

void require_sampleable(const SurfaceMesh& mesh, double voxel, double half_width) {
  constexpr double max_voxels = 2e9, max_coordinate = 1e8;
  double reach = 0;
  for (const Vec3& p : mesh.points) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  const double voxels = area(mesh) / (voxel * voxel) * 2 * half_width;
  if (voxels < max_voxels && reach / voxel < max_coordinate) return;
  throw Error(ExitCode::bad_input,
              fmt::format("the mesh is too large for cells of {:g} m: it reaches {:g} m and its band would take {:.2g} "
                          "voxels; give it a smaller scale",
                          voxel, reach, voxels));
}

std::unique_ptr<SampledDistance> within_domain(std::unique_ptr<SampledDistance> distance, const Frame& frame,
                                               const std::array<int, 3>& cells) {
  return std::make_unique<WithinDomain>(std::move(distance), frame, cells);
}

std::unique_ptr<SampledDistance> nest(std::vector<std::unique_ptr<SampledDistance>> levels) {
  if (levels.size() == 1) return std::move(levels.front());
  return std::make_unique<NestedDistance>(std::move(levels));
}

}  // namespace seiche::vdb
