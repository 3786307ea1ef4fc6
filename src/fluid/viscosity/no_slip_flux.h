#pragma once
// Volume fluxes through cut faces, to second order at no-slip walls.
#include "fluid/viscosity/viscous_samples.h"

namespace seiche {

// Adds w (u at the centroid of the open part - u at the face's centre), m/s, to the closed flux of each cut face. The
// projection uses the velocity at the centre for the whole open part, although it varies near a no-slip wall. u (ghosts
// filled) comes from an earlier solve; `motion` has one motion per solid, unknown ones included. Fills the faces of the
// owned cells and of one layer around. Local.
template <int Dim>
void add_no_slip_flux(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& samples,
                      const std::vector<RigidField>& motion, const FaceField<Dim>& u, FaceField<Dim>& closed_flux);

}  // namespace seiche
