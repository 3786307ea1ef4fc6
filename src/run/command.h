#pragma once
// Implements the verbs run, resume and check.
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/emergency_channel.h"
#include "base/error.h"
#include "files/run_directory.h"
#include "run/log.h"
#include "run/scene.h"
#include "scene/reader.h"

namespace seiche {

// Options that run and resume share.
struct SessionOptions {
  std::optional<int> frames;       // number of the last frame
  std::optional<int> threads;      // of this rank; unset: the machine's processors, shared among its ranks
  std::optional<double> walltime;  // s
  double watchdog = 600;           // s without progress before the run is aborted
  std::string inject;              // see fault.h
  std::string perturbation;        // see coupling/state/operator_perturbation.h
  Verbosity verbosity = Verbosity::normal;
};

struct RunOptions {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> out;  // unset: out/<scene name>
  std::vector<Override> overrides;
  ExistingOutput existing = ExistingOutput::refuse;
  SessionOptions session;
};

struct ResumeOptions {
  std::filesystem::path folder;
  std::optional<double> end;  // s
  std::vector<Override> overrides;
  EditPolicy edits = EditPolicy::refuse;
  SessionOptions session;
};

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<Override> overrides;
  std::filesystem::path frame_folder;  // gets scene.toml and frame 0, as a run directory; empty: nothing is written
  int trial_steps = 0;                 // to measure time and memory by
  std::optional<int> threads;          // as in SessionOptions, for the estimate of time
  bool json = false;                   // one JSON object in place of the table
};

// Environment of a command.
struct Surroundings {
  const Communicator& ranks;
  const EmergencyChannel& emergency;
  Console console;
};

// A note if the end time leaves nothing to simulate, else "".
std::string note_of_end(const Scene& scene);

// All are collective. They return ExitCode::done or ExitCode::stopped, or throw Error.
ExitCode run_command(const RunOptions& options, const Surroundings& around);
ExitCode resume_command(const ResumeOptions& options, const Surroundings& around);
ExitCode check_command(const CheckOptions& options, const Surroundings& around);

}  // namespace seiche
