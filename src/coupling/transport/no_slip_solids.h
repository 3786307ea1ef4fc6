#pragma once
// The no-slip solids beside which transport and viscosity are of second order, seen from the faces.
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// A face centre within a solid.
template <int Dim>
struct FaceInSolid {
  int solid;
  double depth;             // below the surface, cells
  Vec<Dim> normal, center;  // outward; of the face, m
};

// Solids that viscous fluid sticks to, and that neither deform nor are thinner than a cell. None in the scheme of first
// order, and where one of the fluids has no viscosity.
template <int Dim>
class NoSlipSolids {
 public:
  // With the velocities of the last solve. `way`: time from the places that the flow fits to those of `geometry`, s.
  // Keeps references.
  NoSlipSolids(const Setup<Dim>& setup, const State<Dim>& state, const StepGeometry<Dim>& geometry, double way);

  bool any() const;
  // The solid of this kind that contains a face's centre; -1: none.
  int around(int axis, Site face) const;
  // The same where the flow fits the solids, less than `deepest` cells below the surface and not on a side of the
  // domain.
  std::optional<FaceInSolid<Dim>> find(int axis, Site face, const IVec<Dim>& i, double deepest) const;
  // The solid of this kind nearest to a face's centre (-1: none), and the distance from it, m.
  std::pair<int, double> nearest(int axis, Site face) const;
  // Place (m) that a point moving with the solid had when the flow fitted it.
  Vec<Dim> before(int solid, const Vec<Dim>& x) const;
  // Velocity of that flow `u` there, turned with the solid, along the axis of the face i, m/s.
  double moved_flow(const FaceField<Dim>& u, int solid, int axis, const IVec<Dim>& i) const;
  Vec<Dim> velocity(int solid, const Vec<Dim>& x) const {
    return truncate<Dim>(motion_[std::size_t(solid)].at(extend<Dim>(x)));
  }

 private:
  const Layout<Dim>& layout_;
  const StepGeometry<Dim>& geometry_;
  double way_;
  std::vector<char> sticks_;
  std::vector<Twist> motion_;
  std::vector<Eigen::Matrix3d> turn_;  // since then
};

}  // namespace seiche
