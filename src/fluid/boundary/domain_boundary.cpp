#include "fluid/boundary/domain_boundary.h"

#include <algorithm>

#include "base/domain_spec.h"
#include "grid/loops.h"

namespace seiche {

template <int Dim>
DomainBoundary<Dim>::DomainBoundary(const DomainSpec& domain, WallFlow flow, const Vec3& gravity) : flow_(flow) {
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      const SideSpec& spec = domain.sides[a][side];
      types_[a][side] = spec.type;
      velocity_.emplace_back(spec.velocity);
      pressure_.emplace_back(spec.pressure);
      if (spec.type == SideType::waves)
        waves_[a][side] = std::make_shared<const WaveSide>(spec.waves, domain, a, side, gravity);
    }
}

template <int Dim>
double DomainBoundary<Dim>::velocity(int axis, int side, int component, const Vec<Dim>& x, double t) const {
  const SideType s = types_[axis][side];
  if (s == SideType::waves) return waves_[axis][side]->velocity(component, extend<Dim>(x), t);
  if (s != SideType::inflow && s != SideType::moving_wall) return 0;
  return velocity_[2 * axis + side].component(component, extend<Dim>(x), t);
}

template <int Dim>
double DomainBoundary<Dim>::pressure(int axis, int side, const Vec<Dim>& x, double t) const {
  return pressure_[2 * axis + side](extend<Dim>(x), t);
}

template <int Dim>
double DomainBoundary<Dim>::inward_speed(int axis, int side, const Vec<Dim>& x, double t) const {
  if (types_[axis][side] != SideType::inflow) return 0;
  const double v = velocity(axis, side, axis, x, t);
  return std::max(0.0, side == 0 ? v : -v);
}

template <int Dim>
bool DomainBoundary<Dim>::any(std::initializer_list<SideType> wanted) const {
  for (const auto& axis : types_)
    for (const SideType s : axis)
      if (std::find(wanted.begin(), wanted.end(), s) != wanted.end()) return true;
  return false;
}

template <int Dim>
bool DomainBoundary<Dim>::any_inflow() const {
  return any({SideType::inflow});
}

template <int Dim>
bool DomainBoundary<Dim>::any_waves() const {
  return any({SideType::waves});
}

template <int Dim>
bool DomainBoundary<Dim>::any_passes() const {
  return any({SideType::inflow, SideType::outflow, SideType::waves});
}

template <int Dim>
bool DomainBoundary<Dim>::sticks(int axis, int side) const {
  const SideType s = type(axis, side);
  return flow_ == WallFlow::sticks && (s == SideType::no_slip || s == SideType::moving_wall);
}

template <int Dim>
Extensions<Dim> DomainBoundary<Dim>::velocity_extensions(int component) const {
  Extensions<Dim> e;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      const SideType s = type(a, side);
      const bool through = s == SideType::inflow || s == SideType::outflow || s == SideType::waves;
      e[a][side] = through ? Extension::constant : Extension::mirror;
      if (a != component && sticks(a, side)) e[a][side] = Extension::linear;
    }
  return e;
}

template <int Dim>
void fill_velocity_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, const DomainBoundary<Dim>& sides,
                          FaceField<Dim>& u) {
  halo.fill_ghosts(u);
  for (int a = 0; a < Dim; ++a)
    extend_beyond_sides<Dim>(layout, u[a].data(), face_offset<Dim>(a), sides.velocity_extensions(a));
}

template class DomainBoundary<2>;
template class DomainBoundary<3>;
template void fill_velocity_ghosts<2>(const Layout<2>&, const Halo<2>&, const DomainBoundary<2>&, FaceField<2>&);
template void fill_velocity_ghosts<3>(const Layout<3>&, const Halo<3>&, const DomainBoundary<3>&, FaceField<3>&);

}  // namespace seiche
