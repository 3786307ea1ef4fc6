#pragma once
// Contribution of an elastic body to the coupling of solids and liquid.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"

namespace seiche {

struct TimeSpec;

// Adds the pins, inertia and potential of elastic body k; its columns of J go to parts.entries. The unknowns w are
// nodal velocities: the displacements after the horizon H are u + H w. Collective.
template <int Dim>
void couple_elastic_body(const CoupledStep<Dim>& step, int k, const ElasticMotion& motion, int block,
                         CouplingParts<Dim>& parts);

// The same for body k without elements, whose nodes all have prescribed velocities.
template <int Dim>
void couple_deforming_body(const CoupledStep<Dim>& step, int k, const ElasticMotion& motion, int block,
                           CouplingParts<Dim>& parts);

// Sets the columns of J of body k and its cell_fluxes, once parts.entries is complete.
template <int Dim>
void set_elastic_columns(const CoupledStep<Dim>& step, int k, int block, CouplingParts<Dim>& parts);

// Time scheme of elastic solids that matches the liquid's.
ElasticScheme elastic_scheme(const TimeSpec& time);

// Gravity and the scene's forces on an elastic solid over the horizon that follows `state`. dt: the step that led to
// `state`.
template <int Dim>
StepLoad step_load(const Gravity& gravity, const ElasticSolid<Dim>& solid, const State<Dim>& state, double dt,
                   double horizon);

}  // namespace seiche
