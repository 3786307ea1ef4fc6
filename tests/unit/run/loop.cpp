#include "run/loop.h"
#include "base/scene.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <sstream>

#include "files/checkpoint.h"
#include "files/json.h"
#include "run/fault.h"
#include "run/summary.h"
#include "unit/files/scratch.h"
#include "unit/run/fake_simulation.h"

namespace loop_tests {
using namespace seiche;
namespace fs = std::filesystem;

namespace {

Scene small_scene(double end) {
  Scene scene;
  scene.dimension = 2;
  scene.domain.cell_size = 0.5;
  scene.domain.cells = {2, 2, 1};
  scene.time.end = end;
  scene.time.frame_rate = 10;
  scene.liquid.regions.push_back({});
  scene.liquid.regions[0].shape.kind = "box";
  scene.solids.push_back({});
  scene.solids[0].name = "wall";
  scene.solids[0].shape.kind = "box";
  ProbeSpec& probe = scene.probes.emplace_back();
  probe.name = "p", probe.every = 0.05;
  scene.output.formats = {"vdb", "vtk"};
  scene.output.checkpoint_every = 2;
  return scene;
}

// A run directory and the objects around the loop, set up as by a program.
class Bench {
 public:
  explicit Bench(double end) : scene(small_scene(end)), paths{folder.path()} {
    make_folder(paths.frames());
    make_folder(paths.checkpoints());
  }

  RunEnd run() { return go({}); }
  RunEnd resume() {
    std::vector<std::string> warnings;
    const FoundCheckpoint found = find_newest_checkpoint(paths.checkpoints(), ranks, warnings);
    simulation.load(load_checkpoint(found, simulation.checkpoint_boxes(found.data), ranks));
    return go(restore_run_state(found.data));
  }
  ExitCode failing_run() {
    try {
      run();
      return ExitCode::done;
    } catch (const Error& error) {
      message = error.what();
      return error.code();
    }
  }
  std::size_t frames(const std::string& extension) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(paths.frames())) count += entry.path().extension() == extension;
    return count;
  }

  ScratchFolder folder;
  Communicator ranks;
  EmergencyChannel emergency{ranks};
  Scene scene;
  RunPaths paths;
  FakeSimulation simulation;
  std::optional<double> walltime;
  FaultHook hook;
  RunState state;
  std::string message, said, warned;

 private:
  RunEnd go(RunState start) {
    RunLog log(ranks,
               {[&](const std::string& t) { said += t + "\n"; }, [&](const std::string& t) { warned += t + "\n"; }, {}},
               Verbosity::normal);
    Watchdog watchdog(std::chrono::seconds(600), [](const std::string&) {});
    const StopSignals signals;
    RunLoop loop(simulation, {scene, ranks, emergency, paths, log, watchdog, signals, hook, walltime},
                 std::move(start));
    struct Keep {
      RunState& to;
      const RunLoop& from;
      ~Keep() { to = from.state(); }
    } keep{state, loop};
    return loop.run();
  }
};

// The file without its column wall_seconds, which differs between runs.
std::string without_wall_seconds(const fs::path& csv) {
  std::istringstream in(contents(csv));
  std::string line, result;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ','); ++column) {
      if (column != 17) result += cell + ",";
    }
    result += "\n";
  }
  return result;
}

std::size_t lines(const fs::path& file) {
  const std::string text = contents(file);
  return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("frame n is written at n over the frame rate, the first and the last included") {
  Bench bench(0.5);
  const RunEnd end = bench.run();
  CHECK(end.code == ExitCode::done);
  CHECK(bench.state.frame == 5);
  CHECK(bench.state.time == 0.5);
  CHECK(bench.frames(".vdb") == 6);
  CHECK(bench.frames(".vti") == 6);
  CHECK(bench.frames(".vtu") == 6);
  // Steps of 0.03 take four steps per tenth of a second; the initial state and the header are two more lines.
  CHECK(lines(bench.paths.stats()) == 5 * 4 + 2);
  CHECK(lines(bench.paths.solids()) == 5 * 4 + 2);
}

TEST_CASE("the last frame is the one at or before the end, within rounding") {
  TimeSpec time;
  time.frame_rate = 24;
  time.end = 2;
  CHECK(last_frame(time) == 48);
  time.frame_rate = 30;
  time.end = 0.1;
  CHECK(last_frame(time) == 3);  // 0.1 * 30 is below 3 in binary
  time.end = 0.0999;
  CHECK(last_frame(time) == 2);
  time.end = 0;
  CHECK(last_frame(time) == 0);
  time.end = -1;
  CHECK(last_frame(time) == -1);
}

TEST_CASE("an end between two frames is reached without a frame of its own") {
  Bench bench(0.25);
  bench.run();
  CHECK(bench.state.frame == 2);
  CHECK(bench.state.time == 0.25);
}

TEST_CASE("a run that ends before it starts writes headers only") {
  Bench bench(-1);
  CHECK(bench.run().code == ExitCode::done);
  CHECK(lines(bench.paths.stats()) == 1);
  CHECK(bench.frames(".vdb") == 0);
}

TEST_CASE("probes are sampled at the first step end at or after each due time") {
  Bench bench(0.3);
  bench.run();
  // Due at 0, 0.05, ... Steps end at .03, .06, .09, .1 in each tenth, so output is at .06 and .1 of each, and at 0.
  CHECK(lines(bench.paths.probes()) == 1 + 1 + 3 * 2);
}

TEST_CASE("a stopped run goes on to the same bits as an unbroken one") {
  Bench whole(1);
  whole.run();
  Bench parts(1);
  const std::string reason = GENERATE("signal", "file", "wall time", "failure");
  if (reason == "signal") {
    parts.hook = [&](const std::string& phase) {
      if (phase == "stats" && parts.simulation.step_count() == 13) std::raise(SIGUSR1);
      return PhaseFault::none;
    };
  }
  if (reason == "file") {
    parts.hook = [&](const std::string& phase) {
      if (phase == "stats" && parts.simulation.step_count() == 12) put(parts.paths.stop(), "");
      return PhaseFault::none;
    };
  }
  if (reason == "wall time") parts.walltime = 0;
  if (reason == "failure") {
    parts.simulation.fails_at = 7;
    CHECK(parts.failing_run() == ExitCode::cannot_continue);
    parts.simulation.fails_at = -1;
    put(parts.paths.stats(), contents(parts.paths.stats()) + "a row that a crash cut sho");
  } else {
    const RunEnd end = parts.run();
    CHECK(end.code == ExitCode::stopped);
    CHECK(end.how.rfind("stopped: ", 0) == 0);
  }
  CHECK_FALSE(fs::exists(parts.paths.stop()));
  parts.hook = nullptr;
  parts.walltime.reset();
  CHECK(parts.resume().code == ExitCode::done);
  CHECK(without_wall_seconds(parts.paths.stats()) == without_wall_seconds(whole.paths.stats()));
  CHECK(contents(parts.paths.solids()) == contents(whole.paths.solids()));
  CHECK(contents(parts.paths.probes()) == contents(whole.paths.probes()));
  for (const char* name : {"fluid.0010.vti", "solids.0010.vtu", "fluid.pvd"}) {
    CHECK(contents(parts.paths.frames() / name) == contents(whole.paths.frames() / name));
  }
}

TEST_CASE("a step that cannot be done leaves a checkpoint of the state before it") {
  Bench bench(1);
  bench.simulation.fails_at = 7;
  CHECK(bench.failing_run() == ExitCode::cannot_continue);
  CHECK(fs::exists(bench.paths.checkpoints() / "00000006" / "COMMIT"));
  CHECK(lines(bench.paths.stats()) == 6 + 2);
}

TEST_CASE("a value that is not a number is named and not written") {
  Bench bench(1);
  const std::string phase = GENERATE("solve", "stats", "frame", "checkpoint");
  bench.hook = make_fault_hook(parse_injection(phase + ":0:nan:2+"), 0);
  CHECK(bench.failing_run() == ExitCode::cannot_continue);
  CHECK(bench.message.find("not a number") != std::string::npos);
  CHECK(contents(bench.paths.stats()).find("nan") == std::string::npos);
}

TEST_CASE("output that cannot be written ends the run with the last checkpoint in place") {
  Bench bench(1);
  fs::create_symlink("/dev/full", bench.paths.probes());
  CHECK(bench.failing_run() == ExitCode::output_failed);
  CHECK(bench.message.find("probes.csv") != std::string::npos);
}

TEST_CASE("summaries are JSON with the drift relative to the expected volume") {
  RunState state;
  state.initial_volume = 2;
  state.expected_volume = 4;
  state.liquid_volume = 3;
  CHECK(volume_drift(state) == -0.25);
  CHECK(volume_drift(RunState{}) == 0);
  RunSummary summary;
  summary.state = state;
  summary.state.time = 0.1;
  summary.state.worst_residual = std::nan("");
  summary.state.phase_seconds = {{"solve", 1.5}, {"geometry", 2}};
  summary.state.wall_seconds = 4;
  summary.state.step = 2;
  summary.cells = 100;
  summary.peak_memory = 5000;
  CHECK(phase_shares(summary.state) == "geometry 50 %, solve 38 %");
  CHECK(phase_shares(RunState{}).empty());
  const std::string text = format_summary(summary);
  CHECK(json_number(text, "cells_per_second") == 50);
  CHECK(json_number(text, "bytes_per_cell") == 50);
  CHECK(json_number(text, "volume_drift") == -0.25);
  CHECK(json_number(text, "time") == 0.1);
  CHECK(json_value(text, "omp_num_threads") == "null");
  CHECK(json_value(text, "worst_residual") == "null");
  std::size_t last = 0;
  for (const char* part : {"{\n  \"ended\": \"\",", "\n  \"exit_code\": 0,", "\n  \"rejected_steps\": 0,",
                           "\n  \"wall_seconds_by_phase\": {\n    \"geometry\": 2,\n    \"solve\": 1.5\n  },",
                           "\n  \"worst_residual\": null,\n  \"worst_divergence\": 0\n}\n"}) {
    const std::size_t at = text.find(part, last);
    INFO(part << " in " << text);
    REQUIRE(at != std::string::npos);
    last = at;
  }
}

TEST_CASE("docs/outputs.md lists every key of summary.json") {
  std::ifstream file(fs::path(__FILE__).parent_path() / "../../../docs/outputs.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  std::istringstream lines(format_summary({}));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find('"'), last = line.find("\": ");
    if (last == std::string::npos || line.starts_with("    ")) continue;
    const std::string key = line.substr(first + 1, last - first - 1);
    INFO(key);
    CHECK(page.find("`" + key + "`") != std::string::npos);
  }
}

TEST_CASE("a run whose liquid is far from its booked volume says so once") {
  for (const double expected : {1.0, 3.0}) {
    Bench bench(0.2);
    bench.simulation.expected = expected;  // the liquid has 1 to 1.01, a cell 0.25
    bench.run();
    const std::size_t first = bench.warned.find("the liquid's volume is 1");
    CHECK((first != std::string::npos) == (expected > 1));
    CHECK(bench.warned.find("the liquid's volume", first + 1) == std::string::npos);
  }
}

TEST_CASE("drift of the volume is told beyond a twentieth and three cells") {
  RunState state;
  state.initial_volume = state.expected_volume = 100;
  state.liquid_volume = 106;
  CHECK(volume_warning(state, 1).find("+6 %") != std::string::npos);
  CHECK(volume_warning(state, 2.1).empty());
  state.liquid_volume = 95.1;
  CHECK(volume_warning(state, 1).empty());
  state.liquid_volume = 94;
  CHECK(volume_warning(state, 1).find("-6 %") != std::string::npos);
  CHECK(volume_warning(RunState{}, 1).empty());
}

TEST_CASE("the run's own state goes through a checkpoint unchanged") {
  RunState state;
  state.frame = 7;
  state.step = 123;
  state.stats_bytes = 1234567;
  state.probe_due = {{"p.1", 0.1}, {"q", 0.3}};
  state.phase_seconds = {{"solve", 1.5}};
  state.scene_text = "title = \"x\"\n";
  CheckpointData data;
  store(state, data);
  const RunState back = restore_run_state(data);
  CHECK(back.frame == 7);
  CHECK(back.step == 123);
  CHECK(back.stats_bytes == 1234567);
  CHECK(back.probe_due == state.probe_due);
  CHECK(back.phase_seconds == state.phase_seconds);
  CHECK(back.scene_text == state.scene_text);
  data.scalars.erase("run.frame");
  CHECK_THROWS_AS(restore_run_state(data), Error);
}

}  // namespace loop_tests
