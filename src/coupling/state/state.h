#pragma once
// What a simulation is made of (Setup, fixed) and where it stands (State, replaced by each accepted step).
#include <map>
#include <memory>

#include "base/gravity.h"
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/interaction.h"
#include "coupling/state/simulation.h"
#include "coupling/state/tampering.h"
#include "fluid/pressure/pressure.h"
#include "fluid/viscosity/viscosity.h"
#include "solid/contact/contact.h"
#include "solid/elastic/step.h"
#include "solid/mesh/point.h"

namespace seiche {

template <int Dim>
struct Source {
  LiquidSourceSpec spec;
  std::unique_ptr<ShapeField<Dim>> shape;
  VectorExpression velocity;
};

template <int Dim>
struct Setup {
  Scene scene;
  Tampering tampering;
  bool viscous;
  Gravity gravity;
  std::vector<std::string> notes;  // of reading the shapes, for the log
  Communicator ranks;
  Layout<Dim> layout;
  Halo<Dim> halo;
  Sides<Dim> sides;
  std::vector<Body<Dim>> bodies;
  SolidGeometry<Dim> solids;
  Participants<Dim> at_start;  // the solids as the scene begins
  Interactions<Dim> interactions;
  std::optional<ContactScene<Dim>> contact;  // where solids have unknowns
  std::vector<Source<Dim>> sources;
  std::map<std::string, MaterialPoint> followed;  // by displacement probes, by their names

  Setup(const Scene& scene, const Communicator& ranks, const Tampering& tampering = {});
  bool has_unknowns() const;  // of solids
  bool plans_steps() const;   // Participant::plans_steps
  bool may_seal() const;      // Participant::may_seal
  bool is_viscous() const { return viscous; }
  bool keeps_air() const { return scene.gas.present && scene.gas.bubbles == Bubbles::volume_conserving; }
  ElasticScheme elastic_scheme() const {
    return scene.time.scheme == TimeScheme::first_order ? ElasticScheme::backward_euler : ElasticScheme::bdf2;
  }
  double density() const { return scene.liquid.density; }
  bool has_prescribed_flow() const { return scene.liquid.prescribed_velocity.has_value(); }
  bool has_gas() const { return scene.gas.flows(); }
  double gas_density() const { return has_gas() ? scene.gas.density : 0; }
  // Half width of the level-set band, m: what a step can cross, and the reach of the stencils.
  double band() const { return (std::ceil(scene.time.cfl) + 4) * layout.h(); }
  // Layers the velocity is continued beyond the liquid.
  int extrapolated_layers() const { return int(std::ceil(scene.time.cfl)) + 3; }
};

// One time level of the flow.
template <int Dim>
struct Level {
  FaceField<Dim> u;            // m/s, continued beyond the liquid, ghosts filled
  FaceField<Dim, char> valid;  // not 0 where u was solved for or prescribed next to liquid (codes: restore.h)
  FaceField<Dim> q;            // grad p / rho of the step that led here, m/s^2, where valid
  FaceField<Dim> n;            // acceleration by viscosity at this time, m/s^2, where valid; viscous scenes alone
};

// The time levels of one fluid's flow, continued beyond its own region; null where there is none.
template <int Dim>
struct Flow {
  std::shared_ptr<const Level<Dim>> now, before, earlier;
};

// At rest, valid nowhere.
template <int Dim>
Level<Dim> empty_level(const Setup<Dim>& s) {
  const FaceField<Dim> none;
  return {FaceField<Dim>(s.layout), FaceField<Dim, char>(s.layout), FaceField<Dim>(s.layout),
          s.is_viscous() ? FaceField<Dim>(s.layout) : none};
}

// The open part of the faces and their velocities, those of slits as they were solved for (films.h).
template <int Dim>
struct Film {
  FaceField<Dim> open, u;
};

template <int Dim>
struct State {
  double time = 0;
  std::int64_t step = 0;
  std::shared_ptr<const Level<Dim>> now, before, earlier;  // before and earlier are null at the start
  double dt_now = 0, dt_before = 0;                        // steps that led to `now` and to `before`
  Flow<Dim> gas;                                           // where gas flows; now, before, earlier are the liquid's
  Film<Dim> film;                                          // now
  CellField<Dim> phi;                                      // m, ghosts filled
  CellField<Dim> pressure;                                 // Pa, 0 where the cell has no row
  double expected_volume = 0;                              // initial + sources + net inflow, m^Dim
  double corrected_volume = 0;                             // restored by the volume control so far
  Participants<Dim> solids;
  double horizon = 0;           // s ahead that the solids' velocities were solved for
  Parting<Dim> parting;         // where the scene lets liquid part from solids
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

// How a step went; `state` is only set where it succeeded.
template <int Dim>
struct Attempt {
  std::string failure;  // empty: accepted
  State<Dim> state;
  StepGeometry<Dim> geometry;
  StepStats stats;  // volumes, energies, momentum and speed at its end
  SolveReport solve;
  double divergence = 0;
  int newton_iterations = 0, contacts = 0;
  double dissipation = 0;       // by viscosity, W
  int rheology_iterations = 0;  // solves until viscosity and flow agreed
  double parting_error = 0;     // PartingSearch::error
};

// The phases of a step, timed and open to fault injection.
struct Phases {
  Timers timers;
  FaultHook hook;
  std::vector<std::string> warnings;

  PhaseFault enter(const std::string& name) const { return hook ? hook(name) : PhaseFault::none; }
};

// All solids at the state's time, those that move as prescribed with their motion over the step that led there; others
// at rest.
template <int Dim>
std::vector<Placement> place_bodies(const Setup<Dim>& setup, const State<Dim>& state);

// The points that displacement probes follow. Throws Error(bad_input) where one lies outside its solid.
template <int Dim>
std::map<std::string, MaterialPoint> find_followed_points(const Setup<Dim>& setup);

// The initial state of a scene.
template <int Dim>
State<Dim> initial_state(const Setup<Dim>& setup);

// Advances by dt. Collective; the same verdict on all ranks.
template <int Dim>
[[nodiscard]] Attempt<Dim> attempt_step(const Setup<Dim>& setup, const State<Dim>& state, double dt, Phases& phases);

// Largest |u_a| on the faces next to liquid, m/s, over all ranks.
template <int Dim>
double fastest_component(const Setup<Dim>& setup, const State<Dim>& state);

// With bodies in contact a step is at most this much longer than the last one: contact is solved that far ahead.
constexpr double step_growth = 1.25;
// Why a pinned step of dt cannot be taken, with figures; empty where it can: for the flow (collective), and for the
// solids' motions as placed.
template <int Dim>
std::string fault_of_pinned_flow(const Setup<Dim>& setup, const State<Dim>& state, double dt);
template <int Dim>
std::string fault_of_pinned_solids(const Setup<Dim>& setup, const std::vector<Placement>& placed, double t, double dt);

// How far ahead a step that led to `next` after dt solves for the solids' velocities. Where there are elastic solids
// the coming step is meant to be just that long: their motion is second order in time then.
template <int Dim>
double choose_horizon(const Setup<Dim>& setup, const State<Dim>& next, double dt);

// Whether the flow and the solids after a solve allow a step of the length that it was planned for (State::horizon).
// Collective.
template <int Dim>
bool can_go_as_planned(const Setup<Dim>& setup, const State<Dim>& state);

// dt, or as much shorter as it takes that no rigid body meets another solid on the way; 0 where nothing is short
// enough.
template <int Dim>
double hold_back(const Setup<Dim>& setup, const State<Dim>& state, double dt);

// The longest step the scene's limits allow now, ending at or before `until`. Throws Error(cannot_continue) where that
// is hopelessly short, or where a pinned step is too long.
template <int Dim>
double choose_step(const Setup<Dim>& setup, const State<Dim>& state, double until);

}  // namespace seiche
