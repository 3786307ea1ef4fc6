#pragma once
// The part of an elastic body in the coupling of solids and liquid.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"

namespace seiche {

// Adds what concerns the elastic body k; its columns of J go to parts.entries. Its new displacements are u + H w.
// Collective.
template <int Dim>
void couple_elastic_body(const CoupledStep<Dim>& step, int k, const ElasticMotion& motion, int block,
                         CouplingParts<Dim>& parts);

// Sets the columns of J of body k, and what its faces do not show of them, once all entries are there.
template <int Dim>
void set_elastic_columns(const CoupledStep<Dim>& step, int k, int block, CouplingParts<Dim>& parts);

// The scheme in time of elastic solids that goes with the liquid's.
inline ElasticScheme elastic_scheme(const TimeSpec& time) {
  return time.scheme == TimeScheme::first_order ? ElasticScheme::backward_euler : ElasticScheme::bdf2;
}

// Forces on an elastic solid besides liquid and contact in the solve for the horizon that follows `state`, dt the step
// that led there.
template <int Dim>
StepLoad step_load(const Gravity& gravity, const ElasticSolid<Dim>& solid, const State<Dim>& state, double dt,
                   double horizon);

}  // namespace seiche
