#pragma once
// Liquid in slits narrower than a cell: between a body and the floor, or two bodies that come apart.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Faces less open than this carry next to no mass, and jets through such slits say nothing of the flow beside them: the
// projection uses them, transport takes the continued velocity there.
constexpr double least_open = 0.2;

// The velocity as solved for on faces less open than least_open, else as continued.
template <int Dim>
GapFlow<Dim> measure_gap_flow(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FaceField<Dim>& solved,
                              const FaceField<Dim>& continued);

// On the faces of slits that have grown wider, w the open part, u = film.u sqrt(film.w/w) + dt g: what the velocity
// continued from beside a slit does not know is that the liquid in it is under way, and its inertia is most of what a
// body has that lifts off. Liquid pressed out of a narrowing slit leaves as a jet that the grid cannot carry.
template <int Dim>
void set_gap_velocity(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const GapFlow<Dim>& gap_flow,
                      const Vec3& gravity, double dt, FaceField<Dim>& u);

}  // namespace seiche
