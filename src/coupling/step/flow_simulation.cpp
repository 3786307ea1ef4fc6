// The Simulation behind make_simulation: owns setup and state, and tries failed steps again with half the length.
#include <fmt/format.h>

#include "base/checkpoint_boxes.h"
#include "base/error.h"
#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/report/drop_measures.h"
#include "coupling/report/energy_account.h"
#include "coupling/report/energy_budget.h"
#include "coupling/report/measures.h"
#include "coupling/report/scene_account.h"
#include "coupling/report/solid_account.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/state/attempt.h"
#include "coupling/state/checkpoint_state.h"
#include "coupling/state/features.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/step/balance.h"
#include "coupling/step/initial_state.h"
#include "coupling/step/look_ahead.h"
#include "coupling/step/side_flow.h"
#include "coupling/step/solve_notes.h"
#include "coupling/step/step.h"
#include "coupling/step/step_size.h"
#include "coupling/step/volume_measures.h"
#include "coupling/thin/liquid_beside.h"
#include "coupling/transport/dry_sources.h"
#include "coupling/transport/viscous_transport.h"

namespace seiche {
namespace {

// After most_for_energy halvings a step with energy from nowhere counts: its account is not exact. Every
// steps_between_looks steps, the balance of work between ranks is looked at.
constexpr int most_halvings = 7, most_for_energy = 3, steps_between_looks = 16;

template <int Dim>
class FlowSimulation : public Simulation {
 public:
  FlowSimulation(const Scene& scene, const Communicator& ranks, const OperatorPerturbation& perturbation)
      : setup_(std::make_unique<const Setup<Dim>>(scene, ranks, perturbation)), state_(initial_state(*setup_)) {
    geometry_ = measure_geometry();
    surfaces_ = rest_surfaces();
    phases_.warnings = setup_->notes;
    warn_of_long_steps();
    account_ = account_scene(setup_->domain, setup_->fluids, setup_->solids, setup_->scene->domain, state_, geometry_);
    phases_.warnings.insert(phases_.warnings.end(), account_.warnings.begin(), account_.warnings.end());
    refresh_from_state();
  }

  ~FlowSimulation() override { replace_state({}); }  // views outlive the simulation
  void set_fault_hook(FaultHook hook) override { phases_.hook = std::move(hook); }
  double time() const override { return state_.time; }
  std::int64_t step_count() const override { return state_.step; }
  StepStats stats() const override { return stats_; }
  std::vector<SolidState> solids() const override { return solids_; }
  std::vector<JointReport> joints() const override { return report_joints(setup_->solids.joints, state_); }
  double expected_volume() const override { return state_.expected_volume + stats_.volume_since_solve; }
  ProbeSample probe(std::size_t k) const override {
    return measure_probe(*setup_, state_, geometry_on_grid(), solids_, setup_->scene->probes.at(k), probe_fields_);
  }
  FrameField frame_field(const std::string& name) const override {
    return make_frame_field(setup_->domain, setup_->fluids, state_, geometry_on_grid().psi, name);
  }
  std::optional<std::vector<DropPoint>> drops() const override { return drop_points(*setup_, state_); }
  FieldView view(const std::string& name) override {
    FieldView view = make_field_view(setup_->domain, state_, name);
    if (view.owner) return view;
    std::shared_ptr<State<Dim>> kept = kept_.lock();
    if (!kept) kept_ = kept = std::make_shared<State<Dim>>();
    view.owner = kept;
    return view;
  }
  CheckpointData save() const override {
    CheckpointData data = save_state(*setup_, state_);
    if (const std::string blocks = text_of_blocks(setup_->domain); !blocks.empty()) data.texts["blocks"] = blocks;
    return data;
  }
  std::vector<FieldRecord> checkpoint_boxes(const CheckpointData& found) override {
    if (const auto text = found.texts.find("blocks"); text != found.texts.end())
      if (auto blocks = blocks_of_text(text->second, setup_->domain); !blocks.empty()) set_up_again(std::move(blocks));
    return state_boxes(*setup_);
  }
  const Timers& timers() const override { return phases_.timers; }
  std::vector<std::string> take_warnings() override { return std::exchange(phases_.warnings, {}); }

  StepStats step(double until) override {
    const auto start = std::chrono::steady_clock::now();
    if (state_.step % steps_between_looks == 0) balance();
    double dt = choose_step(*setup_, state_, until);
    std::string failures, advice;
    for (int halvings = 0; halvings <= most_halvings && dt > 0;
         ++halvings, dt = hold_back(setup_->solids, state_, dt / 2)) {
      Attempt<Dim> a = attempt_and_break(dt);
      if (a.failure.empty() && halvings < most_for_energy)
        a.failure = fault_of_works(setup_->domain, setup_->fluids, setup_->solids, state_, stats_, a);
      if (a.failure.empty()) {
        accept(std::move(a));
        stats_.rejected = halvings;
        stats_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return stats_;
      }
      failures = fmt::format("step {} of {:.6g} s at time {:.6g} s: {}", state_.step + 1, dt, state_.time, a.failure);
      phases_.warnings.push_back(failures + "; trying half the step");
      advice = a.contradicts ? "change these joints or drives" : remedy();
      for (const std::string& line : a.solve.failed_attempts)
        phases_.warnings.push_back(fmt::format("step {}: {}", state_.step + 1, line));
    }
    const std::string close = nearest_solids(setup_->domain, setup_->solids, setup_->scene->domain, state_);
    throw Error(ExitCode::cannot_continue, fmt::format("{} (after {} halvings; {})", failures, most_halvings,
                                                       close.empty() ? advice : "solids almost in contact: " + close));
  }

  // Drops warnings on the start, which the first run gave. The note on long steps is repeated: `resume --set` may
  // change cfl.
  void load(const CheckpointData& data) override {
    replace_state(load_state(*setup_, data));
    phases_.warnings.clear();
    warn_of_long_steps();
    geometry_ = measure_geometry();
    refresh_from_state();
  }

  SurfaceMesh solid_surface(std::size_t k) const override {
    SurfaceMesh mesh = surfaces_.at(k);
    state_.solids[k].place_points(state_.solids[k].place(state_.time, state_.time, state_.time), mesh.points);
    return mesh;
  }

  VolumeFrame solid_volume(std::size_t k) const override { return state_.solids[k].volume(); }

  std::vector<std::string> describe_start() const override {
    StartAccount start = account_.start;
    add_others(start);
    return lines_of<Dim>(start);
  }

  StartAccount start_account() const override {
    StartAccount start = account_.start;
    add_others(start);
    const std::vector<std::optional<Floating>> floating = floating_of(setup_->solids, setup_->fluids);
    for (std::size_t k = 0; k < floating.size(); ++k) start.solids[k].floating = floating[k];
    return start;
  }

 private:
  // Adds how the volume is kept, features switched off, and meshes of elastic solids.
  void add_others(StartAccount& start) const {
    if (setup_->may_have_fluid()) start.others.push_back(describe_volume(*setup_));
    const std::vector<std::string> features = describe_features(*setup_);
    start.others.insert(start.others.end(), features.begin(), features.end());
    for (std::size_t k = 0; k < state_.solids.size(); ++k)
      if (std::string line = state_.solids[k].describe_mesh(); !line.empty()) start.others.push_back(std::move(line));
  }

  // Moves the state to blocks of equal work where the present ones have become too unequal. Collective.
  void balance() {
    std::vector<Box<Dim>> blocks = better_blocks(setup_->domain, state_);
    if (blocks.empty()) return;
    const auto timed = phases_.timers.measure("balance");
    CheckpointData data = save_state(*setup_, state_);
    set_up_again(std::move(blocks));
    data.fields = redistribute(data.fields, state_boxes(*setup_), setup_->domain.ranks);
    replace_state(load_state(*setup_, data));
    geometry_ = measure_geometry();
  }

  // Leaves no state.
  void set_up_again(std::vector<Box<Dim>> blocks) {
    replace_state({});
    geometry_ = {};
    setup_ = std::make_unique<const Setup<Dim>>(*setup_->scene, setup_->domain.ranks, setup_->perturbation,
                                                std::move(blocks));
  }

  // Repeats the attempt for each joint that it breaks, the most overloaded one first.
  Attempt<Dim> attempt_and_break(double dt) {
    const JointSet<Dim>& joints = setup_->solids.joints;
    for (;;) {
      Attempt<Dim> a = attempt(dt);
      const int j = a.failure.empty() ? most_overloaded(joints, a.state.joints) : -1;
      if (j < 0) return a;
      state_.joints[std::size_t(j)].broken = true;
      phases_.warnings.push_back(
          note_on_break(report_joints(joints, a.state)[std::size_t(j)], a.state.step, a.state.time));
    }
  }

  Attempt<Dim> attempt(double dt) {
    if (state_.step > 0 || setup_->fluids.has_prescribed_flow()) return budgeted_step(state_, dt);
    Attempt<Dim> first = first_step(dt);
    if (first.failure.empty()) book_first_flow(*setup_, state_, geometry_, dt, phases_, first.state);
    return first;
  }

  // Takes the first step twice: a trial finds the pressure slope and the trend of the velocity, the second uses both.
  // Volumes beside solids and open sides set off with the velocity of the trial, in first order too.
  Attempt<Dim> first_step(double dt) {
    const bool second_order = setup_->scene->time.scheme == TimeScheme::second_order;
    State<Dim> before = state_;
    before.looks_ahead = second_order && can_look_ahead(setup_->domain, setup_->solids, state_, geometry_);
    Attempt<Dim> trial = budgeted_step(before, dt);
    if (!trial.failure.empty() || !(second_order || setup_->volume_sets_off())) return trial;
    State<Dim> start = second_order ? inform(trial.state, dt) : state_;
    if (before.looks_ahead) set_off(trial.state, start);
    start.trial = std::make_shared<const State<Dim>>(std::move(trial.state));
    Attempt<Dim> informed = budgeted_step(start, dt);
    if (!second_order) return informed;
    informed.state.earlier = informed.state.exterior->flow.earlier = nullptr;
    informed.state.dt_before = 0;
    return informed;
  }

  // Fails if the kinetic energy exceeds the budget of the present state. `start`: the present state, or this state
  // informed by a trial. The trial's flow adds nothing to the budget, since it has gained energy already.
  Attempt<Dim> budgeted_step(const State<Dim>& start, double dt) {
    Attempt<Dim> a = attempt_step(*setup_, start, dt, phases_);
    if (!a.failure.empty()) return a;
    a.stats = measure(a.state, a.geometry);
    const bool solved = !setup_->fluids.has_prescribed_flow();
    if (solved) a.failure = fault_of_energy(*setup_, state_, stats_, geometry_.psi, a);
    if (!a.failure.empty()) return a;
    a.solids = measure_solids(*setup_, a.state, a.geometry);
    if (solved) a.state.work = work_after(*setup_, state_, stats_, a.solids, a);
    return a;
  }

  StepGeometry<Dim> measure_geometry() const {
    return setup_->solids.geometry.measure(place_moving_bodies(state_), state_.time);
  }

  // With distances, which steps without fluids leave out. Collective: the first call after such a step measures them.
  const StepGeometry<Dim>& geometry_on_grid() const {
    return geometry_.psi.empty() ? geometry_ = measure_geometry() : geometry_;
  }

  // The initial state as if a step of dt had led to it: pressure slope, viscous acceleration and cavities of the trial,
  // u(-dt) = 2 u(0) - u(dt).
  State<Dim> inform(const State<Dim>& trial, double dt) const {
    State<Dim> state = state_;
    inform(trial, state);
    inform(trial.exterior->flow, state.exterior->flow);
    state.dt_now = dt;
    for (const auto& interaction : setup_->solids.interactions) interaction->inform(trial, state);
    return state;
  }

  // Changes nothing if there is no such flow.
  static void inform(const Flow<Dim>& trial, Flow<Dim>& start) {
    if (!start.now) return;
    auto now = std::make_shared<TimeLevel<Dim>>(*start.now), before = std::make_shared<TimeLevel<Dim>>(*start.now);
    now->q = before->q = trial.now->q;
    now->n = before->n = trial.now->n;
    for (int a = 0; a < Dim; ++a)
      for (std::size_t f = 0; f < before->u[a].size(); ++f) before->u[a][f] = 2 * now->u[a][f] - trial.now->u[a][f];
    start.now = std::move(now);
    start.before = std::move(before);
  }

  // Views of the old state go on to show it.
  void replace_state(State<Dim> next) {
    if (const std::shared_ptr<State<Dim>> kept = kept_.lock()) *kept = std::move(state_);
    kept_.reset();
    probe_fields_ = {};
    state_ = std::move(next);
  }

  void accept(Attempt<Dim> a) {
    a.state.viscous_power = a.powers.viscous;
    replace_state(std::move(a.state));
    geometry_ = std::move(a.geometry);
    solve_ = a.solve;
    divergence_ = a.divergence;
    newton_iterations_ = a.newton_iterations;
    contacts_ = a.contacts;
    rheology_iterations_ = a.rheology_iterations;
    separation_error_ = a.separation_error;
    joint_turns_ = a.joint_turns;
    warn_of_solves(a);
    warn_of_crossing();
    dry_sources_.warn(*setup_, state_, geometry_.psi, phases_.warnings);
    for (const std::string& line : a.solve.failed_attempts)
      phases_.warnings.push_back(fmt::format("step {}: {}", state_.step, line));
    refresh(a.stats, a.solids);
  }

  // Advice after a failed step: keys that a resumed run may change.
  std::string remedy() const {
    const TimeSpec& t = setup_->scene->time;
    const std::string step = t.fixed_step ? fmt::format("time.fixed_step={:.3g}", *t.fixed_step / 2)
                                          : fmt::format("time.cfl={:.3g}", t.cfl / 2);
    return fmt::format("try `seiche resume` with --set {} or --set solver.tolerance={:.3g}", step,
                       std::min(10 * setup_->scene->solver.tolerance, 0.01));
  }

  void warn_of_long_steps() {
    const std::string note = note_on_long_steps(setup_->domain, setup_->fluids, setup_->scene->time, state_);
    if (!note.empty()) phases_.warnings.push_back(note);
  }

  // Warns of each kind once.
  void warn_of_solves(const Attempt<Dim>& a) {
    const auto warn_once = [&](bool& told, std::string note) {
      if (!note.empty() && !std::exchange(told, true)) phases_.warnings.push_back(std::move(note));
    };
    warn_once(told_of_separation_, note_on_separation(state_.step, separation_error_));
    warn_once(told_of_rounding_, note_on_rounding(state_.step, a.solve, setup_->scene->solver.tolerance));
    warn_once(told_of_rheology_, note_on_rheology(state_.step, a));
  }

  // Warns once.
  void warn_of_crossing() {
    if (told_of_crossing_) return;
    const std::string line = prescribed_across_periodic_sides(setup_->domain, state_, geometry_.placed);
    told_of_crossing_ = !line.empty();
    if (told_of_crossing_) phases_.warnings.push_back(fmt::format("step {}: {}", state_.step, line));
  }

  // Volumes, energies, momentum and speed of a state.
  StepStats measure(const State<Dim>& state, const StepGeometry<Dim>& geometry) const {
    StepStats stats;
    stats.step = state.step;
    stats.time = state.time;
    stats.dt = state.dt_now;
    measure_fluids(setup_->domain, setup_->fluids, state, geometry.psi, stats);
    if (setup_->tracks_volume()) measure_volumes(*setup_, geometry, state, stats);
    if (setup_->volume_meets_void()) measure_drops(setup_->domain, setup_->fluids, state, stats);
    stats.liquid_volume -= volume_beyond(setup_->domain, setup_->solids, geometry, state.phi);
    stats.kinetic_energy += kinetic_energy_beside(setup_->domain, setup_->fluids, setup_->solids, geometry, state);
    measure_bodies(setup_->fluids, setup_->scene->time, state, stats);
    for (const auto& interaction : setup_->solids.interactions) interaction->measure(state, stats);
    return stats;
  }

  // Updates the answers of stats() and solids() to the present state.
  void refresh(const StepStats& measured, std::vector<SolidState> solids) {
    stats_ = measured;
    stats_.work = state_.work;
    stats_.max_divergence = divergence_;
    stats_.newton_iterations = newton_iterations_;
    stats_.contacts = contacts_;
    stats_.viscous_dissipation = state_.viscous_power.dissipation;
    stats_.rheology_iterations = rheology_iterations_;
    stats_.separation_error = separation_error_;
    stats_.joint_turns = joint_turns_;
    stats_.joint_gap = largest_gap(state_.joints);
    stats_.solver_iterations = solve_.iterations;
    stats_.solver_residual = solve_.residual;
    solids_ = std::move(solids);
  }

  void refresh_from_state() { refresh(measure(state_, geometry_), measure_solids(*setup_, state_, geometry_)); }

  std::vector<SurfaceMesh> rest_surfaces() const {
    std::vector<SurfaceMesh> surfaces;
    for (std::size_t k = 0; k < state_.solids.size(); ++k)
      surfaces.push_back(state_.solids[k].surface_at_rest(setup_->scene->domain));
    return surfaces;
  }

  std::unique_ptr<const Setup<Dim>> setup_;  // before state_, which refers to it
  State<Dim> state_;
  std::weak_ptr<State<Dim>> kept_;  // takes the state once it is over, while a view shows it
  mutable StepGeometry<Dim> geometry_;
  SceneAccount account_;
  Phases phases_;
  std::vector<SurfaceMesh> surfaces_;
  SolveReport solve_;
  double divergence_ = 0, separation_error_ = 0;
  int newton_iterations_ = 0, contacts_ = 0, rheology_iterations_ = 0, joint_turns_ = 0;
  bool told_of_separation_ = false, told_of_rounding_ = false, told_of_rheology_ = false, told_of_crossing_ = false;
  DrySources<Dim> dry_sources_;
  StepStats stats_;
  std::vector<SolidState> solids_;
  mutable ProbeFields<Dim> probe_fields_;
};

}  // namespace

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Communicator& ranks) {
  return make_simulation(scene, ranks, {});
}

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Communicator& ranks,
                                            const OperatorPerturbation& perturbed) {
  if (scene.dimension == 2) return std::make_unique<FlowSimulation<2>>(scene, ranks, perturbed);
  return std::make_unique<FlowSimulation<3>>(scene, ranks, perturbed);
}

}  // namespace seiche
