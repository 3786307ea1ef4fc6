#pragma once
// Sub-grid gap flow: liquid in slits narrower than a cell, between a body and the floor or between separating bodies.
#include <functional>

#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Open fraction below which transport does not use the solved velocity of a face. Such faces carry almost no mass, and
// jets through them say nothing about the flow beside them. The projection uses these faces; transport reads the
// extrapolated velocity there.
constexpr double least_open = 0.2;

// Displacements of liquid or solids in a step, cells. Up to slow_way, flow beside solids at rest keeps its own inertia,
// which conserves energy. From fast_way on it takes the extrapolated velocity and does not get caught in slivers. Both
// are blended linearly in between.
constexpr double slow_way = 0.02, fast_way = 0.1;

// 1 for a way (cells) up to slow_way, 0 from fast_way on, linear between.
double share_of_slow(double way);

// Faces less open than least_open, with the velocities `solved` (m/s).
template <int Dim>
GapFlow<Dim> measure_gap_flow(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FaceField<Dim>& solved);

// On faces of slits that have widened,
//   u = gap_flow.u sqrt(gap_flow.open/open) + dt g.
// The velocity extrapolated from beside a slit misses the motion of the liquid within it, which has most of the inertia
// of a body that lifts off. Narrowing slits are left alone: they expel a jet that the grid cannot resolve.
template <int Dim>
void set_gap_velocity(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const GapFlow<Dim>& gap_flow,
                      const Vec3& gravity, double dt, FaceField<Dim>& u);

// The velocity before the pressure acts, on other faces less open than least_open where `wanted(axis, face)`:
//   u = gap_flow.u + dt g
// where flow and solid are slow. Faces that were not solved for have gap_flow.u = 0 and keep u.
template <int Dim>
void keep_inertia_in_gaps(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const GapFlow<Dim>& gap_flow,
                          const std::function<bool(int, Site)>& wanted, const Vec3& gravity, double dt,
                          FaceField<Dim>& u);

// The velocity that moves a slow surface, on faces less open than least_open between cells of phi (m) of either sign,
// unless transport reads them (`valid`):
//   u = gap_flow.u open / least_open.
// The surface leaves a cell beside a solid through such a face. With the velocity extrapolated from beside, it would
// not follow what the solve lets through, and liquid would vanish there. Fills ghosts. Collective.
template <int Dim>
void let_surface_through_gaps(const Domain<Dim>& domain, const GapFlow<Dim>& gap_flow, const CellField<Dim>& phi,
                              const FaceField<Dim, char>& valid, double dt, FaceField<Dim>& u);

}  // namespace seiche
