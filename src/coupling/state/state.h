#pragma once
// Flow, surface and solids at one time. Each accepted step replaces it.
#include "coupling/state/drops.h"
#include "coupling/state/exterior.h"
#include "coupling/state/flow.h"
#include "coupling/state/fluids.h"
#include "coupling/state/impact.h"
#include "coupling/state/joint_state.h"
#include "coupling/state/participant.h"
#include "fluid/boundary/domain.h"
#include "fluid/pressure/pressure.h"
#include "fluid/viscosity/viscosity.h"
#include "fluid/volume/room.h"

namespace seiche {

// Faces that are hardly open (thin/gap_flow.h): open fractions, and velocities as solved, m/s. 1 and 0 elsewhere.
template <int Dim>
struct GapFlow {
  PagedFaceField<Dim> open, u;

  GapFlow() = default;
  explicit GapFlow(const Layout<Dim>& layout) : open(layout, 1.0), u(layout) {}
};

// The liquid's flow (now, before, earlier) and all else.
template <int Dim>
struct State : Flow<Dim> {
  double time = 0;
  std::int64_t step = 0;
  double dt_now = 0, dt_before = 0;  // steps that led to `now` and `before`, s
  OwnedExterior<Dim> exterior;
  GapFlow<Dim> gap_flow;  // at `now`
  CellField<Dim> phi;     // m, ghosts filled
  // Share of each cell, ghosts filled; empty unless Setup::tracks_volume(). It belongs to time - volume_lag, as do the
  // level set liquid_phi (m), empty unless Setup::volume_lags(), and what `liquid` has beyond its share, empty unless
  // Setup::volume_meets_void().
  CellField<Dim> liquid, liquid_phi, liquid_beyond;
  // Room beside solids: of cells at the time of `liquid`, of faces where `now` fits the solids. Null unless both exist.
  std::shared_ptr<const OpenParts<Dim>> open;
  CellField<Dim> pressure;      // Pa, 0 where the cell has no row
  double expected_volume = 0;   // initial + sources + net inflow, m^Dim
  double corrected_volume = 0;  // restored by the volume control so far, m^Dim
  double spilled_volume = 0;    // of `liquid`, handed to neighbouring cells so far, m^Dim
  Drops<Dim> drops;             // at `time`; only if Setup::volume_meets_void()
  Participants<Dim> solids;
  std::vector<JointState> joints;
  Impacts impacts;         // of solids with restitution, under way
  double since_solve = 0;  // time from the geometry of the last solve to this state, s: half a leapfrog step, or 0
  double volume_lag = 0;   // from the time of `liquid`, s: since_solve, or 0 where the old flow made the second half
  std::shared_ptr<const State> trial = {};  // after a trial of the first step, for the step itself; else null
  bool looks_ahead = false;                 // for a trial that leaves solids where they begin (look_ahead.h)
  double horizon = 0;                       // interval ahead for which the solids' velocities were solved, s
  double planned = 0;                       // length of the coming step that the horizon was made for, s
  Separation<Dim> separation;               // only with separating walls
  double viscous_rate = 0;                  // largest mu/(rho h^2) of the last solve, 1/s
  Work work;                                // since the end of the first step
  ViscousPower viscous_power;               // of the last solve, W
  CellField<Dim, char> sealed;  // cells sealed by elastic walls, their pins and the solids under these; may be empty
  // Loads on each solid by viscous stress (empty if the liquid is inviscid) and by ConvectedPressure (empty if none
  // carries it).
  std::vector<SolidLoad> viscous_loads, convected_loads;

  Room<Dim> room() const { return open ? Room<Dim>(*open) : Room<Dim>(); }
};

// Placements of all solids at the state's time. Prescribed solids have their mean velocity over the last step, others
// zero.
template <int Dim>
std::vector<Placement> place_bodies(const State<Dim>& state);
// The same with the velocities of their unknowns.
template <int Dim>
std::vector<Placement> place_moving_bodies(const State<Dim>& state);

// Largest |u_a| on the valid faces of both fluids and on inflow faces, m/s, over all ranks. Collective.
template <int Dim>
double fastest_component(const Domain<Dim>& domain, const State<Dim>& state);

}  // namespace seiche
