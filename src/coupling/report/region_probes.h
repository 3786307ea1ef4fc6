#pragma once
// Measures of probes over regions: liquid in a box, liquid that passes a flat box, loads of a group of solids.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

struct ProbeSpec;

// Liquid in the probe's box, m^Dim. A cell that the box cuts counts with the part of its liquid that lies within, which
// the level set tells. Collective.
template <int Dim>
double volume_in_box(const Setup<Dim>& setup, const State<Dim>& state, const StepGeometry<Dim>& geometry,
                     const ProbeSpec& probe);

// Liquid that passes the probe's flat box in the direction of its axis, m^Dim/s. Collective.
template <int Dim>
double flux_through_box(const Setup<Dim>& setup, const State<Dim>& state, const StepGeometry<Dim>& geometry,
                        const FaceField<Dim>& u, const ProbeSpec& probe);

// Sum of the forces (N) on the solids that the probe names; of the torques about its point (N m) for a torque probe.
Vec3 sum_of_loads(const std::vector<SolidState>& solids, const ProbeSpec& probe);

}  // namespace seiche
