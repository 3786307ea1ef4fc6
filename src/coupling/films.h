#pragma once
// Liquid in slits narrower than a cell: between a body and the floor, or two bodies about to touch.
#include "coupling/state.h"
#include "fluid/face_geometry.h"

namespace seiche {

// Faces less open than this carry next to no mass, and jets through such slits say nothing of the flow beside them: the
// projection uses them, transport takes the continued velocity there.
constexpr double least_open = 0.2;

// sqrt(w) u on all faces: w open fraction, u as solved for, else continued. Its square is the kinetic energy of a face.
template <int Dim>
FaceField<Dim> film_motion(const Setup<Dim>& setup, const FaceGeometry<Dim>& faces, const FaceField<Dim>& solved,
                           const FaceField<Dim>& continued);

// On the faces of slits, u = film/sqrt(w) + dt g: the velocity continued from beside a slit knows nothing of the liquid
// in it, whose inertia resists and carries on what opens and closes the slit.
template <int Dim>
void set_film_velocity(const Setup<Dim>& setup, const FaceGeometry<Dim>& faces, const FaceField<Dim>& film, double dt,
                       FaceField<Dim>& u);

}  // namespace seiche
