#pragma once
// Shear rates sqrt(2 D:D) of face velocities, 1/s, at cell centres and at edges.
#include "grid/fields.h"

namespace seiche {

// The axes of a plane of rotation, in the order of EdgeField's components.
template <int Dim>
constexpr std::array<int, 2> axes_of_plane(int plane) {
  return Dim == 3 ? std::array<int, 2>{(plane + 1) % 3, (plane + 2) % 3} : std::array<int, 2>{0, 1};
}

// Keeps references. `valid` may be null; then all velocities count.
template <int Dim>
class ShearRates {
 public:
  ShearRates(const Layout<Dim>& layout, const FaceField<Dim>& u, const FaceField<Dim, char>* valid)
      : layout_(layout), u_(u), valid_(valid) {}

  // rate^2 = sum_a 2 (d_a u_a)^2 + sum_{a<b} mean of (d_a u_b + d_b u_a)^2 over the cell's four edges. The mean omits
  // edges in sides of the domain and edges that touch an invalid face, so that it is one-sided next to walls.
  double of_cell(Site cell, const IVec<Dim>& index) const;

  // rate^2 = (d_a u_b + d_b u_a)^2 at the edge itself plus the mean of the other terms over the adjacent cells. On a
  // side of the domain the edge's shear is extrapolated from the three edges inside (a parabola). If there is no shear
  // (an invalid face, or an edge on two sides), the result is the mean of all terms over the adjacent cells.
  double of_edge(int plane, Site edge, const IVec<Dim>& index) const;

 private:
  static constexpr int no_plane = -1;
  bool is_valid(int plane, Site edge) const;
  double shear(int plane, Site edge) const;
  bool lies_in_side(int axis, const IVec<Dim>& index) const;
  bool is_inside(const IVec<Dim>& cell) const;
  template <class Value>
  double mean_of_four(int plane, Site site, const IVec<Dim>& index, int towards, const Value& value) const;
  double mean_squared_shear(int plane, Site cell, const IVec<Dim>& index) const;
  double squared_rate(Site cell, const IVec<Dim>& index, int left_out) const;
  double mean_around(int plane, Site edge, const IVec<Dim>& index, int left_out) const;
  bool shear_at(int plane, Site edge, const IVec<Dim>& index, double& value) const;

  const Layout<Dim>& layout_;
  const FaceField<Dim>& u_;
  const FaceField<Dim, char>* valid_;
};

}  // namespace seiche
