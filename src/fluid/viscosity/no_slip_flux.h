#pragma once
// Volume fluxes through cut faces, to second order at no-slip walls.
#include "fluid/viscosity/viscous_samples.h"

namespace seiche {

// The projection takes the velocity at a face's centre for that of its whole open part, though by a no-slip wall the
// velocity falls to the wall's. Adds w (u at the centroid of the open part - u at the centre), m/s, to the closed flux
// of each cut face, from the velocities u (ghosts filled) of an earlier solve. Unknown motions of bodies are taken to
// be those in `motion`, one a solid. Local; on the faces of the owned cells and one layer around.
template <int Dim>
void add_no_slip_flux(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& samples,
                      const std::vector<RigidField>& motion, const FaceField<Dim>& u, FaceField<Dim>& closed_flux);

}  // namespace seiche
