#pragma once
// Signed distances to a closed surface that changes its shape, and the points of it that are nearest.
#include <unordered_map>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "grid/fields.h"

namespace seiche {

// A point of a surface: on one facet, with the weights of its corners (they add up to one).
template <int Dim>
struct SurfacePoint {
  std::array<int, Dim> corners{};
  std::array<double, Dim> weights{};
};

// Some points of a surface and their weights, which add up to one.
using SurfaceWeights = std::vector<std::pair<int, double>>;

template <int Dim>
class SurfaceDistance {
 public:
  // Of what `layout` stores. Facets are those of `facets`, corners at `points` (m).
  SurfaceDistance(const Layout<Dim>& layout, const SurfaceMesh& facets, const std::vector<Vec<Dim>>& points);

  // Nodes within this box may be nearer than `margin` cells.
  const Box<Dim>& box() const { return box_; }
  // Writes the distance to all nodes of the box, m, negative inside: within two cells of the surface that to the
  // nearest facet, elsewhere about h more a cell.
  void fill(NodeField<Dim>& distance) const;
  // The nearest point of the surface, if it is within two cells.
  bool nearest(const Vec<Dim>& x, SurfacePoint<Dim>& point) const;
  // The weights of its corners; empty if it is not.
  SurfaceWeights nearest_weights(const Vec<Dim>& x) const;
  // The mean over the surface around x, by the area of its facets times (1 - r^2/R^2)^2 within the distance R (m, at
  // most two cells); empty where there is none.
  SurfaceWeights mean_around(const Vec<Dim>& x, double R) const;
  // The unit normal of the nearest facet, outward; zero if that is more than two cells away.
  Vec<Dim> normal_near(const Vec<Dim>& x) const;
  // Signed distance of a point, m; two cells where it is farther away.
  double distance(const Vec<Dim>& x) const;
  // The share of the way from p to q at which it meets the surface first; 2 where it does not. q lies at most two cells
  // from p's cell along each axis.
  double first_crossing(const Vec<Dim>& p, const Vec<Dim>& q) const;

  static constexpr int margin = 4;  // cells

 private:
  struct Nearest {
    double distance2 = 0;
    int facet = -1;
    std::array<double, Dim> weights{};
    Vec<Dim> point;
  };
  std::array<int, Dim> corners(int facet) const;
  std::array<Vec<Dim>, Dim> corner_points(int facet) const;
  void make_bins();
  void make_normals();
  Site cell_of(const Vec<Dim>& x) const;
  Nearest search(const Vec<Dim>& x) const;
  bool is_inside(const Vec<Dim>& x, const Nearest& n) const;
  double winding_number(const Vec<Dim>& x) const;

  const Layout<Dim>& layout_;
  const SurfaceMesh& facets_;
  const std::vector<Vec<Dim>>& points_;
  Box<Dim> box_;
  std::unordered_map<Site, std::vector<int>> bins_;          // facets within reach of the points of a cell
  std::vector<Vec<Dim>> facet_normals_, point_normals_;      // the latter weighted by angles (Baerentzen, Aanaes 2005)
  std::unordered_map<std::int64_t, Vec<Dim>> edge_normals_;  // 3D
};

}  // namespace seiche
