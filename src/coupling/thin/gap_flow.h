#pragma once
// Sub-grid gap flow: liquid in slits narrower than a cell, between a body and the floor or between separating bodies.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Open fraction below which transport does not use the solved velocity of a face. Such faces carry almost no mass, and
// jets through them say nothing about the flow beside them. The projection uses these faces; transport reads the
// extrapolated velocity there.
constexpr double least_open = 0.2;

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

}  // namespace seiche
