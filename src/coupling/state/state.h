#pragma once
// Flow, surface and solids at a time: replaced by each accepted step.
#include <memory>

#include "coupling/state/fluids.h"
#include "coupling/state/participant.h"
#include "fluid/boundary/domain.h"
#include "fluid/pressure/pressure.h"
#include "fluid/viscosity/viscosity.h"

namespace seiche {

// One time level of the flow.
template <int Dim>
struct TimeLevel {
  FaceField<Dim> u;            // m/s, continued beyond the liquid, ghosts filled
  FaceField<Dim, char> valid;  // not 0 where u was solved for or prescribed next to liquid (codes: restore.h)
  FaceField<Dim> q;            // grad p / rho of the step that led here, m/s^2, where valid
  FaceField<Dim> n;            // acceleration by viscosity at this time, m/s^2, where valid; viscous scenes alone
};

// The time levels of one fluid's flow, continued beyond its own region; null where there is none.
template <int Dim>
struct Flow {
  std::shared_ptr<const TimeLevel<Dim>> now, before, earlier;
};

// At rest, valid nowhere.
template <int Dim>
TimeLevel<Dim> empty_level(const Layout<Dim>& layout, bool viscous) {
  return {FaceField<Dim>(layout), FaceField<Dim, char>(layout), FaceField<Dim>(layout),
          viscous ? FaceField<Dim>(layout) : FaceField<Dim>()};
}

// The open part of the faces and their velocities, those of slits as they were solved for (films.h).
template <int Dim>
struct GapFlow {
  FaceField<Dim> open, u;
};

template <int Dim>
struct State {
  double time = 0;
  std::int64_t step = 0;
  std::shared_ptr<const TimeLevel<Dim>> now, before, earlier;  // before and earlier are null at the start
  double dt_now = 0, dt_before = 0;                            // steps that led to `now` and to `before`
  Flow<Dim> gas;                                               // where gas flows; now, before, earlier are the liquid's
  GapFlow<Dim> gap_flow;                                       // now
  CellField<Dim> phi;                                          // m, ghosts filled
  CellField<Dim> pressure;                                     // Pa, 0 where the cell has no row
  double expected_volume = 0;                                  // initial + sources + net inflow, m^Dim
  double corrected_volume = 0;                                 // restored by the volume control so far
  Participants<Dim> solids;
  double horizon = 0;           // s ahead that the solids' velocities were solved for
  Separation<Dim> separation;   // where the scene lets liquid part from solids
  double viscous_rate = 0;      // mu/(rho h^2) of the last solve at its largest, 1/s
  AirRegions<Dim> air;          // where enclosed air keeps its volume
  double lost_air = 0;          // of regions too small for the grid that vanished, m^Dim
  CellField<Dim, char> sealed;  // liquid that elastic walls, their pins and what these stand on seal; may be empty
  std::vector<ViscousLoad> viscous_loads;  // on each solid; empty where the liquid is inviscid
};

template <int Dim>
Flow<Dim> liquid_flow(const State<Dim>& state) {
  return {state.now, state.before, state.earlier};
}

// All solids at the state's time, those that move as prescribed with their motion over the step that led there; others
// at rest.
template <int Dim>
std::vector<Placement> place_bodies(const State<Dim>& state);

// Largest |u_a| on the faces next to liquid, m/s, over all ranks.
template <int Dim>
double fastest_component(const Domain<Dim>& domain, const State<Dim>& state);

}  // namespace seiche
