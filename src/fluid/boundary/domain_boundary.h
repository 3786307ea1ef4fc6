#pragma once
// The sides of the domain: what they let through, and the values beyond them.
#include <vector>

#include "base/domain_spec.h"
#include "base/expression.h"
#include "grid/ghosts.h"
#include "grid/halo.h"

namespace seiche {

// What no-slip and moving walls do to the liquid along them: without viscosity nothing.
enum class WallFlow { slips, sticks };

template <int Dim>
class DomainBoundary {
 public:
  explicit DomainBoundary(const DomainSpec& domain, WallFlow flow = WallFlow::slips);

  SideType type(int axis, int side) const { return types_[axis][side]; }
  bool is_outflow(int axis, int side) const { return type(axis, side) == SideType::outflow; }
  // Velocity of the wall or the inflow at x (component along `axis`); 0 for resting walls.
  double velocity(int axis, int side, int component, const Vec<Dim>& x, double t) const;
  // Pressure beyond an outflow side, Pa.
  double pressure(int axis, int side, const Vec<Dim>& x, double t) const;
  // Speed into the domain through an inflow side, or 0.
  double inward_speed(int axis, int side, const Vec<Dim>& x, double t) const;
  bool any_inflow() const;

  // Whether liquid has the velocity of a wall there.
  bool sticks(int axis, int side) const;
  // How a component of the velocity continues beyond the sides: mirrored at walls, constant through inflow and outflow,
  // straight on along walls that liquid sticks to.
  Extensions<Dim> velocity_extensions(int component) const;

 private:
  std::array<std::array<SideType, 2>, Dim> types_{};
  WallFlow flow_;
  std::vector<VectorExpression> velocity_;
  std::vector<Expression> pressure_;
};

// Halo exchange and continuation beyond the sides. Collective.
template <int Dim>
void fill_velocity_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, const DomainBoundary<Dim>& sides,
                          FaceField<Dim>& u);

}  // namespace seiche
