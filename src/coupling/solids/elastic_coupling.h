#pragma once
// The part of elastic bodies in the coupling of solids and liquid.
#include "coupling/solids/solid_coupling.h"

namespace seiche {

// Fills in what concerns the elastic bodies. Their new displacements are u + H w.
template <int Dim>
void couple_elastic_bodies(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                           const NullSpace& closed, const State<Dim>& state, double dt, double horizon,
                           CouplingParts<Dim>& parts);

// What acts on elastic solid k beside liquid and contact in the solve for the horizon that follows `state`, dt the step
// that led there.
template <int Dim>
StepLoad step_load(const Setup<Dim>& setup, const State<Dim>& state, double dt, double horizon, int k);

}  // namespace seiche
