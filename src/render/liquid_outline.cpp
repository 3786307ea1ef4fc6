// Outlines of the liquid in 2D.
#include <algorithm>
#include <array>
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

// Slope of a level set between two differences of it, all over h. Their mean, but where they differ as at a corner:
// there their harmonic mean, 0 for differences of two signs (Fritsch, Carlson 1980), so that no knob grows beside it.
double slope_between(double low, double high) {
  constexpr double round = 0.5, sharp = 0.8;  // of outlines two cells in radius; of corners
  const double monotone = low * high > 0 ? 2 * low * high / (low + high) : 0;
  const double part = std::clamp((std::abs(high - low) - round) / (sharp - round), 0.0, 1.0);
  return (1 - part) * 0.5 * (low + high) + part * monotone;
}

// Cubic piece between the middle two of four values over h, at t in [0, 1].
double cubic_piece(const std::array<double, 4>& f, double t) {
  const double low = slope_between(f[1] - f[0], f[2] - f[1]), high = slope_between(f[2] - f[1], f[3] - f[2]);
  const double t2 = t * t, t3 = t2 * t;
  return (1 - 3 * t2 + 2 * t3) * f[1] + (3 * t2 - 2 * t3) * f[2] + (t - 2 * t2 + t3) * low + (t3 - t2) * high;
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
    std::array<double, 4> rows{};
    for (int b = 0; b < 4; ++b) {
      std::array<double, 4> row{};
      for (int a = 0; a < 4; ++a) row[std::size_t(a)] = value(i - 1 + a, j - 1 + b) / double(phi_.h);
      rows[std::size_t(b)] = cubic_piece(row, u - i);
    }
    return phi_.h * cubic_piece(rows, v - j);
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
