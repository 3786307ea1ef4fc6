#pragma once
// Signed distances from a closed deforming surface, and its nearest points.
#include <unordered_map>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "grid/fields.h"

namespace seiche {

// A point on a facet of a surface. The weights of the corners (point numbers) add up to one.
template <int Dim>
struct SurfacePoint {
  std::array<int, Dim> corners{};
  std::array<double, Dim> weights{};
};

// Points of a surface with weights that add up to one.
using SurfaceWeights = std::vector<std::pair<int, double>>;

template <int Dim>
class SurfaceDistance {
 public:
  // Covers the sites stored by `layout`. The facets are those of `facets`, with corners at `points` (m). Keeps
  // references.
  SurfaceDistance(const Layout<Dim>& layout, const SurfaceMesh& facets, const std::vector<Vec<Dim>>& points);

  // Stored nodes around the surface. Nodes outside are at least `margin` cells from it.
  const Box<Dim>& box() const { return box_; }
  // Writes the signed distance (m, negative inside) at all nodes of the box. Nodes farther than two cells from the
  // surface get +-2 h.
  void fill(NodeField<Dim>& distance) const;
  // The nearest point of the surface, if it is within two cells.
  bool nearest(const Vec<Dim>& x, SurfacePoint<Dim>& point) const;
  // The nearest point as weights of its facet's corners; empty if it is more than two cells away.
  SurfaceWeights nearest_weights(const Vec<Dim>& x) const;
  // Weights of the mean over the surface within the distance R of x (m, at most two cells), by area times (1 -
  // r^2/R^2)^2. Empty if there is no surface.
  SurfaceWeights mean_around(const Vec<Dim>& x, double R) const;
  // Outward unit normal of the nearest facet; zero if it is more than two cells away.
  Vec<Dim> normal_near(const Vec<Dim>& x) const;
  // Signed distance of a point, m; +2 h if it is farther than two cells, on either side.
  double distance(const Vec<Dim>& x) const;
  // Fraction of the way from p to q at which it meets the surface first; 2 if it does not. q must be at most two cells
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
  bool is_near(const Nearest& n) const;  // within two cells
  bool is_inside(const Vec<Dim>& x, const Nearest& n) const;
  double winding_number(const Vec<Dim>& x) const;

  const Layout<Dim>& layout_;
  const SurfaceMesh& facets_;
  const std::vector<Vec<Dim>>& points_;
  Box<Dim> box_;
  std::unordered_map<Site, std::vector<int>> bins_;          // by cell: facets whose box is within two cells of it
  std::vector<Vec<Dim>> facet_normals_, point_normals_;      // the latter weighted by angles (Baerentzen, Aanaes 2005)
  std::unordered_map<std::int64_t, Vec<Dim>> edge_normals_;  // 3D
};

}  // namespace seiche
