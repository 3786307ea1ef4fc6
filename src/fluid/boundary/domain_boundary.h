#pragma once
// The sides of the domain: boundary conditions, and the values beyond the sides.
#include <initializer_list>
#include <memory>
#include <vector>

#include "base/expression.h"
#include "base/side_type.h"
#include "base/vec.h"
#include "fluid/boundary/wave_side.h"
#include "grid/ghosts.h"
#include "grid/halo.h"

namespace seiche {

struct DomainSpec;

// Tangential condition at no-slip and moving walls. slips: none, for inviscid liquid. sticks: the wall's velocity.
enum class WallFlow { slips, sticks };

template <int Dim>
class DomainBoundary {
 public:
  // `gravity` (m/s^2) is for waves at sides.
  explicit DomainBoundary(const DomainSpec& domain, WallFlow flow = WallFlow::slips,
                          const Vec3& gravity = Vec3::Zero());

  SideType type(int axis, int side) const { return types_[axis][side]; }
  bool is_outflow(int axis, int side) const { return type(axis, side) == SideType::outflow; }
  // Null on sides of other types.
  const WaveSide* waves(int axis, int side) const { return waves_[axis][side].get(); }
  // Velocity of the wall, the inflow or the waves at x, m/s (one component); 0 on sides of other types.
  double velocity(int axis, int side, int component, const Vec<Dim>& x, double t) const;
  // Pressure beyond an outflow side, Pa.
  double pressure(int axis, int side, const Vec<Dim>& x, double t) const;
  // Speed into the domain through an inflow side, m/s; 0 if the flow points outward or the side is of another type.
  double inward_speed(int axis, int side, const Vec<Dim>& x, double t) const;
  bool any_inflow() const;
  bool any_waves() const;
  bool any_passes() const;  // an inflow, an outflow or waves

  // True if no shear acts at this side: it is free or passes waves.
  bool slips(int axis, int side) const {
    return type(axis, side) == SideType::free_slip || type(axis, side) == SideType::waves;
  }

  // True if liquid has the tangential velocity of this side.
  bool sticks(int axis, int side) const;
  // Extension of a velocity component beyond the sides: constant at inflow, outflow and waves, linear for tangential
  // components at walls that liquid sticks to, mirror at other walls.
  Extensions<Dim> velocity_extensions(int component) const;

 private:
  bool any(std::initializer_list<SideType> wanted) const;

  std::array<std::array<SideType, 2>, Dim> types_{};
  WallFlow flow_;
  std::vector<VectorExpression> velocity_;
  std::vector<Expression> pressure_;
  std::array<std::array<std::shared_ptr<const WaveSide>, 2>, Dim> waves_{};
};

// Halo exchange and extension beyond the sides. Collective.
template <int Dim>
void fill_velocity_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, const DomainBoundary<Dim>& sides,
                          FaceField<Dim>& u);

}  // namespace seiche
