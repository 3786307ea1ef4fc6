#pragma once
// Interface of a simulation that advances a scene, for the program, the tests and other programs.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/checkpoint_data.h"
#include "base/communicator.h"
#include "base/timers.h"
#include "coupling/state/start_account.h"
#include "geometry/mesh/mesh.h"
#include "solid/mesh/volume_frame.h"

namespace seiche {

struct Scene;

// Work done on the fluids and the solids that forces move, and the energy they lost, since the end of the first step,
// J (2D: J/m). With E = kinetic + elastic energy and E_1 = E at the end of the first step:
//   E - E_1 = gravity + tension + sides + solids - lost_viscous - lost_numerical
struct Work {
  double gravity = 0;
  double tension = 0;       // of surface tension
  double sides = 0;         // of sides and sources: pressure, shear, energy of the liquid that enters less that leaves
  double solids = 0;        // of prescribed solids, pins and forces that the scene applies
  double lost_viscous = 0;  // heat from viscosity
  double lost_numerical = 0;  // all else: transport, the step's rule; impacts, friction and dampers too
};

// One row of stats.csv; docs/outputs.md names the columns. 2D: per metre of depth.
struct StepStats {
  std::int64_t step = 0;
  double time = 0, dt = 0;
  double liquid_volume = 0, kinetic_energy = 0, potential_energy = 0, elastic_energy = 0;
  Vec3 momentum{0, 0, 0};
  double max_speed = 0, max_divergence = 0;
  int solver_iterations = 0;
  double solver_residual = 0;
  int newton_iterations = 0, contacts = 0;
  std::int64_t cells_liquid = 0;
  double wall_seconds = 0;
  // further columns
  double gas_volume = 0;           // of flowing gas, or of enclosed air, m^3
  double volume_corrected = 0;     // liquid volume restored by the volume control since the start, m^3
  double volume_spilled = 0;       // handed to neighbouring cells since the start, m^3
  double volume_drifting = 0;      // in cells away from the level set's liquid, m^3
  double volume_since_solve = 0;   // brought by sides and feeds since the time of volumes; in liquid_volume, m^3
  std::int64_t drops = 0;          // that fly as points
  double volume_drops = 0;         // in them, m^3
  double volume_left_out = 0;      // of drops that were not kept (liquid.spray), since the start, m^3
  int rejected = 0;                // attempts at this step that were rejected
  double viscous_dissipation = 0;  // what viscous stress takes from the flow in this step, over dt, W
  std::int64_t bubbles = 0;        // enclosed air regions that keep their volume
  double air_lost = 0;             // volume of regions that became too small for the grid, since the start, m^3
  int rheology_iterations = 0;     // solves until viscosity and flow agree; 0 for Newtonian liquid
  Work work;
  // Separating walls: largest violation by a cell on the wrong side of the unilateral condition, over the largest
  // pressure. Suction in attached cells or squeeze in separated ones; 0: none.
  double separation_error = 0;
  double joint_gap = 0;  // largest that the last solve left at its end, m
  int joint_turns = 0;   // of solves that closed joints
};

// One row of solids.csv.
struct SolidState {
  std::string name;
  Vec3 position{0, 0, 0};                         // centre of mass (Body::reference_point), m
  std::array<double, 4> orientation{1, 0, 0, 0};  // quaternion w, x, y, z
  Vec3 velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  Vec3 force{0, 0, 0}, torque{0, 0, 0};                // from the fluid, N and N m about position
  Vec3 pin_force{0, 0, 0}, pin_torque{0, 0, 0};        // likewise, from the pins of an elastic solid
  Vec3 unseen_force{0, 0, 0}, unseen_torque{0, 0, 0};  // part of both that the solve, with faces of the grid, misses
};

// One row of joints.csv. Loads act on the joint's first solid, the torque about the joint's point.
struct JointReport {
  std::string name;
  double q = 0, rate = 0;  // coordinate and its rate: rad, rad/s or m, m/s; 0 without one
  Vec3 force{0, 0, 0}, torque{0, 0, 0};
  Vec3 point{0, 0, 0};  // where it is, m; the end at the second solid of a distance or a rope
  double power = 0;     // into the solids, of drive, motor and prescribed solids, W
  double gap = 0;       // m
  bool broken = false;
};

struct ProbeSample {
  std::string name;
  bool is_vector = false;
  bool defined = true;  // false: nothing to measure (a pressure probe in the air, no liquid in the column)
  double value = 0;
  Vec3 vector{0, 0, 0};
};

// A field for a frame: this rank's owned cells, first axis fastest; vectors (staggered, low faces) as triples. Units:
// surface m, vel m/s, pressure Pa, vorticity 1/s, viscosity Pa s.
struct FrameField {
  std::string name;  // surface, vel, pressure, vorticity, viscosity
  enum class Kind { level_set, scalar, staggered_vector } kind = Kind::scalar;
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  std::vector<float> values;
};

// Liquid too little for the grid, as a point. radius: of the ball, in 2D the disc, of its volume.
struct DropPoint {
  Vec3 place{0, 0, 0}, velocity{0, 0, 0};  // m, m/s
  double radius = 0;                       // m
  std::int64_t id = 0;                     // its own for as long as it flies
};

// Values where the simulation holds them: entry (i, j, k) of this rank's block is first[i s_0 + j s_1 + k s_2].
struct FieldView {
  std::string name;
  const double* first = nullptr;
  std::array<int, 3> lower{0, 0, 0}, shape{1, 1, 1};  // index of the block's first entry in the domain; entries
  std::array<std::ptrdiff_t, 3> strides{0, 0, 0};     // in doubles
  std::shared_ptr<const void> owner;                  // keeps the values, also when steps have gone on
};

// Size of the run, known before the first step.
struct Cost {
  std::int64_t cells = 0;
  double bytes = 0;  // over all ranks
};

// Called on every rank at the start of each phase of a step (transport, geometry, solve, restore). Tells the watchdog
// where the run is and lets tests inject faults; may throw. On `poison` the simulation writes a NaN into one owned
// value of the phase's result. The same step must detect it.
enum class PhaseFault { none, poison };
using FaultHook = std::function<PhaseFault(const std::string& phase)>;

// A run that needs more steps to its next frame is given up.
constexpr int most_steps_a_frame = 1'000'000;

class Simulation {
 public:
  virtual ~Simulation() = default;
  virtual void set_fault_hook(FaultHook hook) = 0;
  virtual double time() const = 0;
  virtual std::int64_t step_count() const = 0;
  // Advances by one step that ends at or before `until` (s). Throws Error(cannot_continue) if all attempts with shorter
  // steps fail; the state is then as before the step. Collective.
  virtual StepStats step(double until) = 0;
  virtual StepStats stats() const = 0;                             // of the present state
  virtual std::vector<SolidState> solids() const = 0;              // equal on all ranks
  virtual std::vector<JointReport> joints() const { return {}; }   // equal on all ranks
  virtual SurfaceMesh solid_surface(std::size_t index) const = 0;  // at the present time
  // Elements of an elastic solid with their fields at the present time; empty for other solids. Not collective: called
  // on rank 0 only. Its surface_nodes are the points of solid_surface(index).
  virtual VolumeFrame solid_volume(std::size_t /*index*/) const { return {}; }
  // Lines for the log: liquid and solids at the start, features switched off, meshes of elastic solids.
  virtual std::vector<std::string> describe_start() const { return {}; }
  // The same in numbers, with the draughts of floating bodies.
  virtual StartAccount start_account() const { return {}; }
  // Both are collective, and const for what they show alone: after a step that left the grid out, the first call
  // places the solids on it, which all ranks do together. No two threads may call them at once.
  virtual ProbeSample probe(std::size_t index) const = 0;  // equal on all ranks
  // Owned cells of a field: surface (continued into solids), closed_surface (without what lies in them), vel, pressure,
  // viscosity, vorticity.
  virtual FrameField frame_field(const std::string& name) const = 0;
  // Drops of this rank, by id. Empty if the scene makes none.
  virtual std::optional<std::vector<DropPoint>> drops() const { return {}; }
  // The values of a field without copying them: surface (m), pressure (Pa) at cells; velocity_x, velocity_y, velocity_z
  // (m/s) at low faces, with the high face of the last cell along their axis. They stay as they are when steps go on.
  virtual FieldView view(const std::string& name) = 0;
  virtual double expected_volume() const = 0;  // initial + sources + net inflow, m^3
  virtual CheckpointData save() const = 0;
  // Restores the state. `data.fields` hold this rank's boxes, as `save()` returns them on as many ranks.
  virtual void load(const CheckpointData& data) = 0;
  // Boxes that load() needs on this rank: name, lower, upper; values empty. Takes the blocks of the checkpoint that was
  // found if it is of as many ranks; then only load() may follow. Collective.
  virtual std::vector<FieldRecord> checkpoint_boxes(const CheckpointData& found) = 0;
  virtual const Timers& timers() const = 0;
  virtual std::vector<std::string> take_warnings() = 0;  // since the last call, for the log; equal on all ranks
};

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Communicator& ranks);
Cost estimate_cost(const Scene& scene, int ranks);

}  // namespace seiche
