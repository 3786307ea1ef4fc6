// Surfaces cut along the cells of a grid.
#include <catch2/catch.hpp>
#include <random>

#include "geometry/mesh/facet_pieces.h"

namespace facet_pieces_tests {
using namespace seiche;

namespace {

template <int Dim>
Geometry<Dim> grid_of(int cells) {
  Geometry<Dim> g;
  g.h = 1.0 / cells;
  g.cells.setConstant(cells);
  return g;
}

double measure(const std::vector<FacetWeights<2>>& outline) {
  return (outline[1] - outline[0]).norm() / std::sqrt(2.0);
}
double measure(const std::vector<FacetWeights<3>>& outline) {
  double sum = 0;
  for (std::size_t n = 1; n + 1 < outline.size(); ++n) {
    const FacetWeights<3> a = outline[n] - outline[0], b = outline[n + 1] - outline[0];
    sum += a[1] * b[2] - a[2] * b[1];
  }
  return sum;
}

// Cuts a facet with random corners in the unit box. Returns the sum of the pieces' fractions, and the largest distance
// (cells) of a piece's corner outside its cell.
template <int Dim>
std::pair<double, double> cut_random_facet(unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> at(0, 1);
  const Geometry<Dim> grid = grid_of<Dim>(7);
  std::vector<Vec<Dim>> points(Dim);
  for (Vec<Dim>& p : points)
    for (double& x : p) x = at(engine);
  SurfaceMesh surface;
  surface.segments = {{0, 1}};
  surface.triangles = {{0, 1, 2}};
  double share = 0, outside = 0;
  for (const FacetPiece<Dim>& piece : cut_at_cells<Dim>(grid, grid.box(), surface, points)) {
    share += measure(piece.outline);
    for (const FacetWeights<Dim>& w : piece.outline) {
      Vec<Dim> x = Vec<Dim>::Zero();
      for (int i = 0; i < Dim; ++i) x += w[i] * points[std::size_t(i)] / grid.h;
      const Vec<Dim> low = piece.cell.template cast<double>() - x, high = x - piece.cell.template cast<double>();
      outside = std::max({outside, low.maxCoeff(), high.maxCoeff() - 1});
    }
  }
  return {share, outside};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("pieces of a facet make up all of it, each in its cell", "[facet_pieces]", ((int Dim), Dim), 2,
                       3) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto [share, outside] = cut_random_facet<Dim>(seed);
    CHECK(share == Approx(1).epsilon(1e-12));
    CHECK(outside <= 1e-12);
  }
}

TEST_CASE("a facet in the plane between two cells belongs to the one on its outer side", "[facet_pieces]") {
  const Geometry<2> grid = grid_of<2>(4);
  const std::vector<Vec<2>> points{{0.5, 0.05}, {0.5, 0.2}};
  SurfaceMesh up, down;
  up.segments = {{0, 1}};  // the inside lies to its left: x < 0.5
  down.segments = {{1, 0}};
  CHECK(cut_at_cells<2>(grid, grid.box(), up, points).at(0).cell == IVec<2>(2, 0));
  CHECK(cut_at_cells<2>(grid, grid.box(), down, points).at(0).cell == IVec<2>(1, 0));
}

}  // namespace facet_pieces_tests
