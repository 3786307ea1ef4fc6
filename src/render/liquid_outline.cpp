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

// Slope of a level set at an end of a piece, over h, from the differences beside the piece and of the piece itself:
// their mean, but where they differ as at a corner the piece's own. Corners stay, and no knob grows beside them.
double slope_at_end(double beside, double own) {
  constexpr double round = 0.5, sharp = 0.8;  // of outlines two cells in radius; of corners
  const double part = std::clamp((std::abs(beside - own) - round) / (sharp - round), 0.0, 1.0);
  return (1 - part) * 0.5 * (beside + own) + part * own;
}

// Cubic piece between the middle two of four values over h, at t in [0, 1].
double cubic_piece(const std::array<double, 4>& f, double t) {
  const double own = f[2] - f[1], low = slope_at_end(f[1] - f[0], own), high = slope_at_end(f[3] - f[2], own);
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
    return 0.5 * phi_.h * (piece(i, j, {u - i, v - j}, 0) + piece(i, j, {u - i, v - j}, 1));
  }

 private:
  // Over h, at t from the centre of cell i, j: first along an axis, then along the other. The mean of both orders is
  // the same for turned scenes.
  double piece(int i, int j, const std::array<double, 2>& t, int first) const {
    std::array<double, 4> lines{};
    for (int b = 0; b < 4; ++b) {
      std::array<double, 4> line{};
      for (int a = 0; a < 4; ++a)
        line[std::size_t(a)] = value(i - 1 + (first == 0 ? a : b), j - 1 + (first == 0 ? b : a)) / double(phi_.h);
      lines[std::size_t(b)] = cubic_piece(line, t[std::size_t(first)]);
    }
    return cubic_piece(lines, t[std::size_t(1 - first)]);
  }
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
