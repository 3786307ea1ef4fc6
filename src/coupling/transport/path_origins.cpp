#include "coupling/transport/path_origins.h"

#include "base/time_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/transport/restore.h"
#include "fluid/boundary/domain.h"
#include "fluid/boundary/inflow.h"
#include "fluid/transport/advection.h"
#include "grid/interpolation.h"
#include "grid/loops.h"

namespace seiche {
namespace {

using VelocityRange = std::pair<double, double>;

// Range of velocity of the valid faces among a face and its neighbours, m/s; first > second if none is valid.
template <int Dim>
VelocityRange valid_range(const Layout<Dim>& layout, const TimeLevel<Dim>& level, int axis, Site f) {
  VelocityRange range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  constexpr int neighbours = Dim == 2 ? 9 : 27;
  for (int n = 0; n < neighbours; ++n) {
    Site at = f;
    for (int a = 0, left = n; a < Dim; ++a, left /= 3) at += (left % 3 - 1) * layout.stride(a);
    if (!level.valid.at(axis, at)) continue;
    range = {std::min(range.first, level.u.at(axis, at)), std::max(range.second, level.u.at(axis, at))};
  }
  return range;
}

// The face nearest to x of those whose neighbours are all stored.
template <int Dim>
Site nearest_face(const Layout<Dim>& layout, int axis, const Vec<Dim>& x) {
  const Vec<Dim> g = index_coordinates<Dim>(layout, x, face_offset<Dim>(axis));
  IVec<Dim> i;
  for (int a = 0; a < Dim; ++a)
    i[a] = int(std::clamp(std::round(g[a]), layout.padded().lower[a] + 1.0, layout.padded().upper[a] - 2.0));
  return layout.site(i);
}

// Faces of a component within `reach` cells of a side, except those on the side.
template <int Dim>
Box<Dim> faces_behind(const Layout<Dim>& layout, int axis, int side, int component, int reach) {
  Box<Dim> box = layout.faces(component);
  const int n = layout.geometry().cells[axis], on_side = component == axis ? 1 : 0;
  if (side == 0) box.lower[axis] = std::max(box.lower[axis], on_side);
  if (side == 0) box.upper[axis] = std::min(box.upper[axis], reach + on_side);
  if (side == 1) box.lower[axis] = std::max(box.lower[axis], n - reach);
  if (side == 1) box.upper[axis] = std::min(box.upper[axis], n);
  return box;
}

// Acceleration by gravity, pressure and viscosity in the last step, m/s^2. Free fall on faces that were not solved. An
// impact changes velocity by an amount independent of dt. So the magnitude is at most |g|, or h/4 in a step if that is
// more.
template <int Dim>
double acceleration_at(const Domain<Dim>& domain, const Fluids& fluids, const TimeLevel<Dim>& level, int axis, Site f,
                       double g, double dt) {
  if (!is_solved(level.valid.at(axis, f))) return g;
  const double most = std::max(std::abs(g), 0.25 * domain.layout.h() / (dt * dt));
  const double viscous = fluids.is_viscous() ? level.n.at(axis, f) : 0;
  return std::clamp(g - level.q.at(axis, f) + viscous, -most, most);
}

}  // namespace

template <int Dim>
void limit_at_surfaces(const Domain<Dim>& domain, const TimeLevel<Dim>& level, const FacePaths<Dim>& paths,
                       const FaceField<Dim, char>& interior, FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    for_each_marked_index(domain.layout, domain.layout.faces(a), paths.near[a].data(), [&](Site f, const IVec<Dim>& i) {
      if (interior.at(a, f)) return;
      const Vec<Dim> from = departure_of_face(domain.layout, paths.velocity, a, f, i, paths.dt);
      VelocityRange range = valid_range(domain.layout, level, a, nearest_face(domain.layout, a, from));
      if (range.first > range.second) range = valid_range(domain.layout, level, a, f);
      if (range.first <= range.second) u.at(a, f) = std::clamp(u.at(a, f), range.first, range.second);
    });
}

// Wanted after the solve is u_in + tau A, with tau the time since the entry and A the acceleration. The solve adds dt
// (A - g) and the viscous part that is not in `memory`. Hence u* = u_in + dt g - (dt - tau) A + memory.
template <int Dim>
void let_liquid_in(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                   const OperatorPerturbation& perturbation, const TimeLevel<Dim>& level, const FacePaths<Dim>& paths,
                   double t, const FaceField<Dim>& memory, FaceField<Dim>& u) {
  const double dt = paths.dt;
  const Vec3 g = perturbation.gravity * fluids.gravity.of_step(t + dt, dt);
  const int reach = int(std::ceil(time.cfl)) + 1;
  for (int axis = 0; axis < Dim; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (domain.sides.type(axis, side) != SideType::inflow) continue;
      for (int a = 0; a < Dim; ++a)
        for_each_index_in_order(
            domain.layout, faces_behind(domain.layout, axis, side, a, reach), [&](Site f, const IVec<Dim>& i) {
              if (!paths.near.at(a, f)) return;
              const Vec<Dim> from = departure_of_face(domain.layout, paths.velocity, a, f, i, dt);
              const auto entry =
                  find_entry(domain.layout, domain.sides, from, domain.layout.position(i, face_offset<Dim>(a)), t, dt);
              if (!entry) return;
              const double before = dt - entry->inside, acc = acceleration_at(domain, fluids, level, a, f, g[a], dt);
              u.at(a, f) = velocity_of(domain.sides, *entry)[a] + dt * g[a] - before * acc + memory.at(a, f);
            });
    }
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template void limit_at_surfaces<D>(const Domain<D>&, const TimeLevel<D>&, const FacePaths<D>&,                \
                                     const FaceField<D, char>&, FaceField<D>&);                                 \
  template void let_liquid_in<D>(const Domain<D>&, const Fluids&, const TimeSpec&, const OperatorPerturbation&, \
                                 const TimeLevel<D>&, const FacePaths<D>&, double, const FaceField<D>&,         \
                                 FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
