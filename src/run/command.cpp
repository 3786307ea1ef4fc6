#include "run/command.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/agree.h"
#include "base/scene.h"
#include "coupling/state/operator_perturbation.h"
#include "files/checkpoint.h"
#include "run/fault.h"
#include "run/loop.h"
#include "run/memory.h"
#include "run/mesh_extents.h"
#include "run/session.h"
#include "run/tables.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

// Throws Error(bad_input).
void check_test_options(const SessionOptions& session) {
  parse_injection(session.inject);
  parse_perturbation(session.perturbation);
}

// Reads the scene; the same on all ranks.
Scene read_together(const fs::path& file, const std::vector<Override>& overrides, const Communicator& ranks) {
  Scene scene;
  agree(ranks, "reading the scene", [&] { scene = read_scene(file, overrides); });
  return scene;
}

void check_machine(const Scene& scene, const Communicator& ranks) {
  const int here = ranks_on_this_machine(ranks);
  agree(ranks, "estimating the memory",
        [&] { check_memory(estimate_cost(scene, ranks.size()), ranks.size(), here, machine_memory()); });
}

// End time for `--frames N`: the last frame has number N.
double end_of_frames(int frames, const Scene& scene) {
  return frames / scene.time.frame_rate;
}

fs::path output_folder(const RunOptions& options) {
  return options.out.value_or(fs::path("out") / options.scene.stem());
}

// Throws Error(bad_input) if a change forbids resuming; permitted changes are logged.
void accept_changed_scene(const Scene& scene, const Scene& before, EditPolicy edits, const fs::path& folder,
                          RunLog& log) {
  const std::vector<std::string> changed = changed_keys(before, scene), keys = forbidden_changes(changed, edits);
  if (keys.empty()) {
    if (!changed.empty()) log.note(fmt::format("changed since the run was stopped: {}", fmt::join(changed, ", ")));
    return;
  }
  const char* remedy = edits == EditPolicy::force ? "start a new run"
                                                  : "undo that, or give --force where only output or probes changed, "
                                                    "or start a new run";
  throw Error(ExitCode::bad_input,
              fmt::format("{}: changed since the run was stopped: {}; {} (only time.end, time.cfl, time.max_step, "
                          "time.fixed_step, liquid.volume, output.checkpoint_every and [solver] may change freely)",
                          (folder / "scene.toml").string(), fmt::join(keys, ", "), remedy));
}

void apply_new_end(const ResumeOptions& options, Scene& scene) {
  if (options.end) scene.time.end = *options.end;
  if (options.session.frames) scene.time.end = end_of_frames(*options.session.frames, scene);
}

bool is_finished(const RunState& state, const Scene& scene) {
  return state.frame >= last_frame(scene.time) && state.time >= scene.time.end * (1 - 1e-12);
}

// Contents of the run directory that resume continues from.
struct Continuation {
  Scene scene;
  FoundCheckpoint checkpoint;
  RunState state;
};

Continuation read_run(const ResumeOptions& options, const Communicator& ranks, RunLog& log) {
  const RunPaths paths{options.folder};
  Continuation run{read_together(paths.scene(), options.overrides, ranks), {}, {}};
  std::vector<std::string> warnings;
  run.checkpoint = find_newest_checkpoint(paths.checkpoints(), ranks, warnings);
  for (const std::string& text : warnings) log.warn(text);
  agree(ranks, "comparing the scene", [&] {
    run.state = restore_run_state(run.checkpoint.data);
    const Scene before = parse_scene(run.state.scene_text, "the checkpoint's scene", paths.folder);
    if (run.checkpoint.label.scene_hash != scene_hash(run.scene)) {
      accept_changed_scene(run.scene, before, options.edits, paths.folder, log);
    }
  });
  agree_on_root(ranks, "comparing the tables", [&] {
    for (const std::string& fault : verify_tables(paths, options.edits, run.state))
      log.warn(fault + "; continuing with the rows that are there (--force)");
  });
  return run;
}

// The way of a checkpoint, which "auto" may not change: cells and drops would be lost, or missing.
VolumeKeeping volume_keeping(const CheckpointData& data) {
  const auto is_liquid = [](const FieldRecord& field) { return field.name == "liquid"; };
  return std::ranges::any_of(data.fields, is_liquid) ? VolumeKeeping::in_cells : VolumeKeeping::by_shift;
}

// Warns where a run that carried volumes by cells goes on with a shift.
void warn_of_lost_volumes(VolumeKeeping held, const Scene& scene, RunLog& log) {
  if (held == VolumeKeeping::in_cells && scene.liquid.volume == VolumeKeeping::by_shift)
    log.warn(
        "liquid.volume = \"shift\": the volumes that cells carried are given up; drops in flight vanish, and the shift "
        "of the surface brings their volume back");
}

}  // namespace

std::string note_of_end(const Scene& scene) {
  if (scene.time.end > 0) return {};
  return "note: the end time (time.end) is not after the start, 0 s: nothing is simulated";
}

ExitCode run_command(const RunOptions& options, const Surroundings& around) {
  const Communicator& ranks = around.ranks;
  RunLog log(ranks, around.console, options.session.verbosity);
  agree(ranks, "reading the options", [&] { check_test_options(options.session); });
  Scene scene = read_together(options.scene, options.overrides, ranks);
  if (options.session.frames) scene.time.end = std::min(scene.time.end, end_of_frames(*options.session.frames, scene));
  check_machine(scene, ranks);
  std::vector<std::string> wide;
  agree(ranks, "reading meshes", [&] { wide = check_mesh_extents(scene); });
  for (const std::string& text : wide) log.warn(text);
  if (stopped_early(ranks, log)) return ExitCode::stopped;
  const fs::path folder = output_folder(options);
  const auto announce = [&](const RunContents& held) {
    log.note(fmt::format("note: --overwrite removes the run in {}: {}", folder.string(), describe_contents(held)));
  };
  const auto directory = open_directory(folder, options.existing, ranks, announce);
  if (const std::string note = note_of_end(scene); !note.empty()) log.note(note);
  return run_session({scene, around, options.session, log, RunPaths{fs::absolute(folder).lexically_normal()}}, {});
}

ExitCode resume_command(const ResumeOptions& options, const Surroundings& around) {
  const Communicator& ranks = around.ranks;
  RunLog log(ranks, around.console, options.session.verbosity);
  agree(ranks, "reading the options", [&] { check_test_options(options.session); });
  const auto directory = open_directory(options.folder, ExistingOutput::resume, ranks);
  Continuation run = read_run(options, ranks, log);
  apply_new_end(options, run.scene);
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  if (run.scene.time.end < run.state.time * (1 - 1e-12))
    log.warn(fmt::format("the end time (time.end), {:g} s, lies before the time that the run has reached",
                         run.scene.time.end));
  if (is_finished(run.state, run.scene)) {
    log.note(fmt::format("note: the run in {} is finished (t = {:g} s); give a later --end to extend it",
                         folder.string(), run.state.time));
    return ExitCode::done;
  }
  check_machine(run.scene, ranks);
  const VolumeKeeping held = volume_keeping(run.checkpoint.data);
  warn_of_lost_volumes(held, run.scene, log);
  log.note(fmt::format(
      "resuming at step {}, t = {:g} s{}", run.state.step, run.state.time,
      run.checkpoint.ranks == ranks.size() ? "" : fmt::format(" (written by {} ranks)", run.checkpoint.ranks)));
  const Restore restore = [&](Simulation& simulation) {
    simulation.load(load_checkpoint(run.checkpoint, simulation.checkpoint_boxes(run.checkpoint.data), ranks));
    return run.state;
  };
  return run_session({run.scene, around, options.session, log, RunPaths{folder}, held}, restore);
}

}  // namespace seiche
