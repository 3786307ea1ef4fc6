#pragma once
// The acceleration that transport carries along paths, predicted from the pressure of earlier steps.
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct TimeSpec;

// True if liquid crosses at most two cells in dt. Extrapolation in time amplifies what longer steps carry
// (docs/decisions/0005-smoothed-pressure-trend.md). Collective.
template <int Dim>
bool may_extrapolate(const Domain<Dim>& domain, const State<Dim>& state, double dt);

// A = f - G: acceleration of a fluid at t + dt/2 from state.time = t, m/s^2, with G the pressure slope plus its trend.
// Faces that are not `deep` in known flow, near a free surface say, take the minmod of A and that of the step before.
// Flow that is smooth in time keeps A there, thin jets and drops do not
// (docs/decisions/0030-transport-near-surfaces.md). A is continued beyond the fluid. Zero without an earlier step and
// in first order. `reached`: see reached_sites(); 0 elsewhere. Ghosts filled. Collective.
template <int Dim>
FaceField<Dim> carried_acceleration(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                    const OperatorPerturbation& perturbation, const State<Dim>& state,
                                    const Flow<Dim>& flow, const CellField<Dim, char>& reached,
                                    const FaceField<Dim, char>& deep, double dt);

}  // namespace seiche
