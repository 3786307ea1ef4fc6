#pragma once
// Estimates of what a run costs, from the scene at its start: memory, disk, steps, time.
#include <optional>
#include <string>
#include <vector>

#include "coupling/state/simulation.h"
#include "files/json.h"

namespace seiche {

struct Scene;

// Counts that the cost of a run follows from, over all ranks.
struct RunSize {
  double cells = 0;        // of the domain
  double fluid = 0;        // cells that hold liquid at the start, or gas that flows
  double near = 0;         // the same, cells within three cells of them, and a share for liquid that enters
  double band = 0;         // cells within three cells of the liquid's surface
  double nodes = 0;        // of elastic solids
  double factors = 0;      // bytes of their Cholesky factors
  double facets = 0;       // of the surfaces of all solids
  double solid_bytes = 0;  // files of solids in one frame
  double fall = 0;         // mean height that liquid has to fall until it lies flat between the solids, m
  double speed = 0;        // of the liquid, m/s
  double solid_speed = 0;  // of kinematic solids, m/s
  double feed_speed = 0;   // of liquid that enters, m/s
};

// Collective; equal on all ranks.
RunSize measure_size(const Scene& scene, const Simulation& simulation, const Communicator& ranks);

// Steps that were made as a trial.
struct TrialSteps {
  int steps = 0;
  double seconds = 0;               // of wall time for a step: the median without the first one
  double fastest = 0, slowest = 0;  // likewise
  double dt = 0;                    // of simulated time for a step: the mean, s
  double memory = 0;                // peak so far over all ranks, bytes
};

// Bytes over all ranks and for the whole run.
struct RunEstimate {
  double memory = 0;
  int frames = 0;
  double frame_bytes = 0, checkpoint_bytes = 0, table_bytes = 0;  // one frame; two checkpoints; all tables
  double disk() const { return frames * frame_bytes + checkpoint_bytes + table_bytes; }
  double steps = 0, seconds = 0;  // of wall time
};

// Estimate with so many ranks of so many threads; by trial steps if there are some.
RunEstimate estimate_run(const Scene& scene, const RunSize& size, int ranks, int threads,
                         const std::optional<TrialSteps>& trial);

// Memory, disk, steps and time for people.
std::vector<std::string> estimate_lines(const Scene& scene, const RunEstimate& estimate, int ranks, int threads,
                                        const std::optional<TrialSteps>& trial);

JsonMembers size_json(const RunSize& size);
JsonMembers estimate_json(const RunEstimate& estimate, const std::optional<TrialSteps>& trial);

}  // namespace seiche
