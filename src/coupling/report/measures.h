#pragma once
// What a run reports about a state: energies, momentum, forces on solids, probes, fields for frames.
#include "coupling/state/state.h"

namespace seiche {

// Energy, momentum, volumes and speed of liquid and gas. Collective.
template <int Dim>
void measure_fluids(const Setup<Dim>& setup, const State<Dim>& state, const NodeField<Dim>& psi, StepStats& stats);

// Kinetic energy of liquid and gas, where they are now, with the velocities of one step before, J; 0 at the start.
// Collective.
template <int Dim>
double kinetic_energy_of_fluids_before(const Setup<Dim>& setup, const State<Dim>& state, const NodeField<Dim>& psi);

// Counts enclosed air. Collective.
template <int Dim>
void measure_air(const Setup<Dim>& setup, const State<Dim>& state, const NodeField<Dim>& psi, StepStats& stats);

// Adds energies and momentum of the solids.
template <int Dim>
void measure_bodies(const Setup<Dim>& setup, const State<Dim>& state, StepStats& stats);

// Pose, velocity and the liquid's force and torque on every solid. Collective.
template <int Dim>
std::vector<SolidState> measure_solids(const Setup<Dim>& setup, const State<Dim>& state,
                                       const StepGeometry<Dim>& geometry);

// One sample of a probe. Collective; equal on all ranks.
template <int Dim>
ProbeSample measure_probe(const Setup<Dim>& setup, const State<Dim>& state, const ProbeSpec& probe);

// A field of the owned cells: surface, vel, pressure, vorticity, viscosity.
template <int Dim>
FrameField make_frame_field(const Setup<Dim>& setup, const State<Dim>& state, const std::string& name);

}  // namespace seiche
