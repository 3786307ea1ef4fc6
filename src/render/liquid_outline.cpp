// Outlines of the liquid in 2D.
#include <cmath>
#include <set>

#include "geometry/shapes/shapes.h"
#include "render/outline.h"
#include "render/plot.h"

namespace seiche::render {
namespace {

constexpr double most_nodes = 2e6;  // of the contour's grid, where the cells alone are not more

// Parts of a cell's side, between which the contour is straight: three, fewer on grids that are fine anyway.
int parts_of_cell(const ScalarVolume& phi) {
  const double cells = double(phi.cells[0]) * phi.cells[1];
  return std::clamp(int(std::sqrt(most_nodes / cells)), 1, 3);
}

// Weights of four values in the Catmull-Rom curve between the middle two, at t in [0, 1].
std::array<double, 4> cubic_weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t + 2 * t2 - t3), 0.5 * (2 - 5 * t2 + 3 * t3), 0.5 * (t + 4 * t2 - 3 * t3), 0.5 * (t3 - t2)};
}

// The level set between the cells' centres, by cubic pieces where the surface is near.
class SmoothLevelSet : public ShapeField<2> {
 public:
  explicit SmoothLevelSet(const ScalarVolume& phi) : phi_(phi) {}

  double operator()(const Vec<2>& x) const override {
    const double u = (x[0] - phi_.lower[0]) / phi_.h - 0.5, v = (x[1] - phi_.lower[1]) / phi_.h - 0.5;
    const int i = int(std::floor(u)), j = int(std::floor(v));
    const float nearest = value(int(std::lround(u)), int(std::lround(v)));
    if (!(std::abs(nearest) < 2 * phi_.h)) return nearest;  // the band of a distance: no surface within the cell
    const auto along_x = cubic_weights(u - i), along_y = cubic_weights(v - j);
    double sum = 0;
    for (int b = 0; b < 4; ++b)
      for (int a = 0; a < 4; ++a)
        sum += along_y[std::size_t(b)] * along_x[std::size_t(a)] * value(i - 1 + a, j - 1 + b);
    return sum;
  }

 private:
  float value(int i, int j) const {
    return phi_.at(std::clamp(i, 0, phi_.cells[0] - 1), std::clamp(j, 0, phi_.cells[1] - 1), 0);
  }

  const ScalarVolume& phi_;
};

}  // namespace

std::vector<Polygon> liquid_outlines(const ScalarVolume& phi) {
  const Box domain = phi.box();
  const Vec<2> lower = domain.lower.head<2>().cast<double>(), upper = domain.upper.head<2>().cast<double>();
  const Vec<2> beyond = Vec<2>::Constant(phi.h);
  SolidMesh contour;
  contour.mesh =
      closed_contour<2>(SmoothLevelSet(phi), double(phi.h) / parts_of_cell(phi), lower - beyond, upper + beyond);
  contour.solid.assign(contour.mesh.segments.size(), 0);
  return close_outlines(contour, 0, domain);
}

}  // namespace seiche::render
