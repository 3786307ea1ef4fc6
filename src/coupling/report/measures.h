#pragma once
// Reported quantities of a state: energies, momentum, forces on solids, probes, fields for frames.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct ProbeSpec;
struct TimeSpec;

// Energy, momentum, volumes and speed of liquid and gas, and the columns of the exterior. Collective.
template <int Dim>
void measure_fluids(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, const NodeField<Dim>& psi,
                    StepStats& stats);

// Kinetic energy (J) of liquid and gas at their present places with the velocities of the time level before. 0 at the
// start. Collective.
template <int Dim>
double kinetic_energy_of_fluids_before(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                                       const NodeField<Dim>& psi);

// Adds energies and momentum of the solids.
template <int Dim>
void measure_bodies(const Fluids& fluids, const TimeSpec& time, const State<Dim>& state, StepStats& stats);

// Pose, velocity and the liquid's force and torque on every solid. Collective.
template <int Dim>
std::vector<SolidState> measure_solids(const Setup<Dim>& setup, const State<Dim>& state,
                                       const StepGeometry<Dim>& geometry);

// Fields of one state that several probes share; empty until one needs them.
template <int Dim>
struct ProbeFields {
  std::array<std::optional<FieldValues<double>>, 2> pressure;  // Pa, continued from beyond the surface, and from liquid
  std::shared_ptr<const TimeLevel<Dim>> flow;                  // of all fluids
};

// One sample of a probe. `geometry`: of the last solve; `solids`: at the state. Collective; equal on all ranks.
template <int Dim>
ProbeSample measure_probe(const Setup<Dim>& setup, const State<Dim>& state, const StepGeometry<Dim>& geometry,
                          const std::vector<SolidState>& solids, const ProbeSpec& probe, ProbeFields<Dim>& fields);

// Material points of displacement probes, by name of the probe. Throws Error(bad_input) if one lies outside its solid.
template <int Dim>
std::map<std::string, MaterialPoint> find_followed_points(const std::vector<ProbeSpec>& probes,
                                                          const Solids<Dim>& solids);

// A field of the owned cells: surface, vel, pressure, vorticity, viscosity.
template <int Dim>
FrameField make_frame_field(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                            const NodeField<Dim>& psi, const std::string& name);

// View of a field in a state (Simulation::view); owner is set for velocities alone, which steps do not change.
template <int Dim>
FieldView make_field_view(const Domain<Dim>& domain, const State<Dim>& state, const std::string& name);

}  // namespace seiche
