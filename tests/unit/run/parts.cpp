#include <atomic>
#include <catch2/catch.hpp>
#include <csignal>
#include <limits>
#include <thread>

#include "base/agree.h"
#include "base/base64.h"
#include "base/error.h"
#include "files/vtk.h"
#include "run/fault.h"
#include "run/memory.h"
#include "run/progress.h"
#include "run/scene.h"
#include "run/signals.h"
#include "run/watchdog.h"

namespace parts_tests {
using namespace seiche;
using namespace std::chrono_literals;

namespace {

ExitCode code_of_memory(double bytes, const MachineMemory& memory) {
  try {
    check_memory({1000, bytes}, 4, 2, memory);
    return ExitCode::done;
  } catch (const Error& error) {
    return error.code();
  }
}

}  // namespace

TEST_CASE("the watchdog speaks once when beats stay away and names the last phase") {
  std::atomic<int> spoken = 0;
  std::string phase;
  {
    Watchdog watchdog(200ms, [&](const std::string& p) {
      phase = p;
      ++spoken;
    });
    for (int n = 0; n < 10; ++n) {
      watchdog.beat("solve");
      std::this_thread::sleep_for(20ms);
    }
    CHECK(spoken == 0);
    std::this_thread::sleep_for(600ms);  // three times the limit, for a busy machine
  }
  CHECK(spoken == 1);
  CHECK(phase == "solve");
}

TEST_CASE("stop signals are noted, not fatal") {
  const StopSignals signals;
  CHECK(signals.received() == 0);
  std::raise(SIGTERM);
  CHECK(signals.received() == SIGTERM);
  std::raise(SIGXFSZ);
  CHECK(signal_name(SIGUSR1) == "SIGUSR1");
}

TEST_CASE("a signal before a run's own handlers stand is not lost") {
  note_stop_signals();
  std::raise(SIGTERM);
  CHECK(noted_signal() == SIGTERM);
  {
    const StopSignals signals;
    CHECK(signals.received() == SIGTERM);
  }
  CHECK(noted_signal() == 0);
}

TEST_CASE("injections strike at the visit, rank and phase that they name") {
  const FaultHook hook = make_fault_hook(parse_injection("solve:1:nan:2"), 1);
  CHECK(hook("solve") == PhaseFault::none);
  CHECK(hook("frame") == PhaseFault::none);
  CHECK(hook("solve") == PhaseFault::poison);
  CHECK(hook("solve") == PhaseFault::none);
  CHECK(make_fault_hook(parse_injection("solve:1:throw"), 0)("solve") == PhaseFault::none);
  CHECK_THROWS_AS(make_fault_hook(parse_injection("solve:0:throw"), 0)("solve"), std::runtime_error);
  CHECK_THROWS_AS(make_fault_hook(parse_injection("solve:0:badalloc"), 0)("solve"), std::bad_alloc);
  CHECK_THROWS_AS(parse_injection("solve:0:surprise"), Error);
  CHECK_THROWS_AS(parse_injection("solve"), Error);
}

TEST_CASE("work agreed on throws one error, with memory shortage told as such") {
  const Communicator ranks;
  CHECK_NOTHROW(agree(ranks, "work", [] {}));
  try {
    agree(ranks, "packing", [] { throw std::bad_alloc(); });
    FAIL("did not throw");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::machine);
    CHECK(std::string(error.what()) == "out of memory while packing");
  }
}

TEST_CASE("a grid that never fits is the scene's fault, one that does not fit now the machine's") {
  const double unlimited = std::numeric_limits<double>::infinity();
  // Two of four ranks are on this machine, so half of the estimate counts.
  CHECK(code_of_memory(100, {60, 55, unlimited}) == ExitCode::done);
  CHECK(code_of_memory(130, {60, 55, unlimited}) == ExitCode::bad_input);
  CHECK(code_of_memory(115, {60, 55, unlimited}) == ExitCode::machine);
  CHECK(code_of_memory(100, {60, 55, 20}) == ExitCode::machine);
  CHECK(readable_bytes(1536) == "1.5 KiB");
  CHECK(machine_memory().available > 0);
}

TEST_CASE("edits of a scene between stop and resume pass or stand in the way as documented") {
  const std::vector<std::string> numerical{"solver.tolerance", "solver.preconditioner", "solver.viscosity", "time.cfl",
                                           "time.max_step",    "time.fixed_step",       "liquid.volume"};
  CHECK(forbidden_changes(numerical, EditPolicy::refuse).empty());
  const std::vector<std::string> keys{"time.end",      "liquid.density",          "output.frames", "time.frame_rate",
                                      "probe.0.every", "output.checkpoint_every", "time.scheme"};
  CHECK(forbidden_changes(keys, EditPolicy::force) ==
        std::vector<std::string>{"liquid.density", "time.frame_rate", "time.scheme"});
  CHECK(forbidden_changes(keys, EditPolicy::refuse).size() == 5);
}

TEST_CASE("durations read as hours, minutes and seconds") {
  CHECK(readable_seconds(3.4) == "3 s");
  CHECK(readable_seconds(123) == "2:03");
  CHECK(readable_seconds(3723) == "1:02:03");
}

TEST_CASE("VTK files hold every field over the whole domain, velocities averaged to cell centres") {
  vdb::Frame frame;
  frame.dimension = 2;
  frame.cell_size = 0.5;
  // Two ranks with 3 x 1 cells each; u = 2, 4, 8 on the lower faces.
  frame.grids.push_back({"vel",
                         vdb::GridKind::staggered_vector,
                         0,
                         {{{0, 0, 0}, {2, 1, 1}, {2, 0, 0, 4, 0, 0}}, {{2, 0, 0}, {3, 1, 1}, {8, 0, 0}}}});
  const std::string text = vtk::image(frame, {3, 1, 1});
  const std::uint64_t size = 9 * sizeof(float);
  const float centred[9] = {3, 0, 0, 6, 0, 0, 8, 0, 0};
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(centred), sizeof centred);
  CHECK(text.find(encode_base64(bytes)) != std::string::npos);
  CHECK(text.find("WholeExtent=\"0 3 0 1 0 1\"") != std::string::npos);
  const std::string surfaces =
      vtk::surfaces({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}, {}}, {"duck", "b&w"}, 1.5);
  CHECK(surfaces.find("Name=\"solid_names\" NumberOfTuples=\"2\" format=\"ascii\">100 117 99 107 0 98 38 119 0 <") !=
        std::string::npos);
  CHECK(surfaces.find("NumberOfPoints=\"3\" NumberOfCells=\"1\"") != std::string::npos);
  JointReport pin{.name = "pin", .q = 0.5, .force = {1, 2, 3}, .point = {0.1, 0.2, 0}};
  const std::string joints = vtk::joints({pin, pin}, 1.5);
  CHECK(joints.find("NumberOfPoints=\"2\" NumberOfCells=\"2\"") != std::string::npos);
  const double forces[6] = {1, 2, 3, 1, 2, 3};
  const std::uint64_t length = sizeof forces;
  std::string raw(reinterpret_cast<const char*>(&length), sizeof length);
  raw.append(reinterpret_cast<const char*>(forces), sizeof forces);
  CHECK(joints.find(encode_base64(raw)) != std::string::npos);
  CHECK(vtk::series("solids", "vtu", 2, 24).find("solids.0002.vtu") != std::string::npos);
}

}  // namespace parts_tests
