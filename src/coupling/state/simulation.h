#pragma once
// A scene being advanced: what the program, the tests and programs of others drive.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/checkpoint_data.h"
#include "base/communicator.h"
#include "base/timers.h"
#include "geometry/mesh/mesh.h"
#include "solid/mesh/volume_frame.h"

namespace seiche {

struct Scene;

// One row of stats.csv; the contract names the columns. 2D: per metre of depth.
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
  // further columns of ours
  double gas_volume = 0;           // of gas that flows, or of the enclosed air, m^3
  double volume_corrected = 0;     // liquid volume restored by the volume control since the start, m^3
  int rejected = 0;                // attempts at this step that were rejected
  double viscous_dissipation = 0;  // energy that viscosity turned into heat in this step, over dt, W
  std::int64_t bubbles = 0;        // enclosed regions of air that keep their volume
  double air_lost = 0;             // of those that became too small for the grid, since the start, m^3
  int rheology_iterations = 0;     // solves with viscosities of the last one's shear rate; 0 for Newtonian liquid
  // Pull or squeeze, over the largest pressure, of cells that part or not against the rule; 0: all parted as they
  // should.
  double separation_error = 0;
};

// One row of solids.csv.
struct SolidState {
  std::string name;
  Vec3 position{0, 0, 0};                         // centre of mass (Body::reference_point), m
  std::array<double, 4> orientation{1, 0, 0, 0};  // quaternion w, x, y, z
  Vec3 velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  Vec3 force{0, 0, 0}, torque{0, 0, 0};          // from the fluid, N and N m about position
  Vec3 pin_force{0, 0, 0}, pin_torque{0, 0, 0};  // likewise, from the pins of an elastic solid
};

struct ProbeSample {
  std::string name;
  bool is_vector = false;
  bool defined = true;  // false: nothing to measure (a pressure probe in the air, no liquid in the column)
  double value = 0;
  Vec3 vector{0, 0, 0};
};

// A field for a frame: this rank's owned cells, first axis fastest; vectors (staggered, low faces) as triples.
struct FrameField {
  std::string name;  // surface, vel, pressure, vorticity, viscosity
  enum class Kind { level_set, scalar, staggered_vector } kind = Kind::scalar;
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  std::vector<float> values;
};

// Facts known before the first step.
struct Cost {
  std::int64_t cells = 0;
  double bytes = 0;  // over all ranks
};

// Called at the start of each named phase of a step (transport, geometry, solve, restore) on every rank: tells the
// watchdog where the run is, and lets tests inject faults: it may throw, and answers poison when the simulation is to
// write a NaN into one owned value of the phase's result (which must then be caught in the same step).
enum class PhaseFault { none, poison };
using FaultHook = std::function<PhaseFault(const std::string& phase)>;

// Steps to the next frame beyond which a run is given up.
constexpr int most_steps_a_frame = 1'000'000;

class Simulation {
 public:
  virtual ~Simulation() = default;
  virtual void set_fault_hook(FaultHook hook) = 0;
  virtual double time() const = 0;
  virtual std::int64_t step_count() const = 0;
  // Advances by one step that ends at or before `until`. Throws Error(cannot_continue) after the ladder is exhausted,
  // with the state as before the step. All ranks call it together.
  virtual StepStats step(double until) = 0;
  virtual StepStats stats() const = 0;                             // of the present state
  virtual std::vector<SolidState> solids() const = 0;              // equal on all ranks
  virtual SurfaceMesh solid_surface(std::size_t index) const = 0;  // at the present time
  // The elements of an elastic solid at the present time, with their fields; empty for other solids. Not collective:
  // called on rank 0 alone. Its surface_nodes are the points of solid_surface(index).
  virtual VolumeFrame solid_volume(std::size_t /*index*/) const { return {}; }
  // For the log: liquid and solids as the scene began, features that others switch off, meshes of elastic solids.
  virtual std::vector<std::string> describe_start() const { return {}; }
  virtual ProbeSample probe(std::size_t index) const = 0;  // collective; equal on all ranks
  virtual FrameField frame_field(const std::string& name) const = 0;
  virtual double expected_volume() const = 0;  // initial + sources + net inflow, m^3
  virtual CheckpointData save() const = 0;
  // Takes the state back. `data.fields` hold this rank's boxes, as `save()` of this rank count would give them.
  virtual void load(const CheckpointData& data) = 0;
  // The boxes (name, lower, upper; values empty) that load() wants on this rank.
  virtual std::vector<FieldRecord> checkpoint_boxes() const = 0;
  virtual const Timers& timers() const = 0;
  virtual std::vector<std::string> take_warnings() = 0;  // since the last call, for the log; equal on all ranks
};

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Communicator& ranks);
Cost estimate_cost(const Scene& scene, int ranks);

}  // namespace seiche
