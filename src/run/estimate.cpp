#include "run/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/gravity.h"
#include "base/scene.h"
#include "coupling/state/memory_model.h"
#include "files/vtk.h"
#include "run/expected_speed.h"
#include "run/loop.h"
#include "run/memory.h"
#include "run/progress.h"
#include "solid/elastic/solid.h"

namespace seiche {
namespace {

constexpr double pi = 3.14159265358979323846;

// Sums over the owned cells.
struct CellSums {
  double fluid = 0, near = 0, band = 0;
};

CellSums sum_cells(const Scene& scene, const Simulation& simulation) {
  const FrameField phi = simulation.frame_field("surface");
  const double reach = 2.999 * scene.domain.cell_size;  // frames may end their distances at 3 h
  CellSums sums;
  for (const auto& value : phi.values) {
    sums.near += value < reach;
    sums.band += std::abs(value) < reach;
    sums.fluid += value < 0;
  }
  if (scene.gas.flows()) sums.fluid = sums.near = double(phi.values.size());
  return sums;
}

// Share of the domain's cells that liquid from sources and sides comes near to, on the mean over a run: a guess.
constexpr double inflow_share = 0.04;

bool has_inflow(const Scene& scene) {
  if (!scene.liquid.sources.empty()) return true;
  for (const auto& sides : scene.domain.sides)
    for (const SideSpec& side : sides)
      if (side.type == SideType::inflow) return true;
  return false;
}

// Bytes of the files of solids in a frame: their texts as a run writes them.
double bytes_of_solids(const Scene& scene, const std::vector<SurfaceMesh>& surfaces,
                       const std::vector<VolumeFrame>& volumes, const Simulation& simulation) {
  if (surfaces.empty()) return 0;
  std::vector<std::string> names;
  for (const SolidSpec& solid : scene.solids) names.push_back(solid.name);
  double bytes = double(vtk::surfaces(surfaces, names, 0).size());
  const bool elastic =
      std::any_of(volumes.begin(), volumes.end(), [](const VolumeFrame& v) { return !v.elements.empty(); });
  if (elastic) bytes += double(vtk::volumes(volumes, names, 0).size());
  for (const VolumeFrame& volume : volumes) bytes += 12.0 * double(volume.surface_nodes.size());  // of the point cache
  if (!scene.joints.empty()) bytes += double(vtk::joints(simulation.joints(), 0).size());
  return bytes;
}

void measure_solids_at_start(const Scene& scene, const Simulation& simulation, RunSize& size) {
  std::vector<SurfaceMesh> surfaces;
  std::vector<VolumeFrame> volumes;
  for (std::size_t k = 0; k < scene.solids.size(); ++k) {
    surfaces.push_back(simulation.solid_surface(k));
    volumes.push_back(simulation.solid_volume(k));
    size.facets += double(surfaces[k].triangles.size() + surfaces[k].segments.size());
    const double nodes = double(volumes[k].rest.size());
    size.nodes += nodes;
    if (!volumes[k].elements.empty()) size.factors += factor_bytes(scene.dimension, int(nodes) * scene.dimension);
  }
  size.solid_speed = speed_of_kinematic_solids(scene, surfaces);
  size.solid_bytes = bytes_of_solids(scene, surfaces, volumes, simulation);
}

}  // namespace

RunSize measure_size(const Scene& scene, const Simulation& simulation, const Communicator& ranks) {
  RunSize size;
  const auto& n = scene.domain.cells;
  size.cells = double(n[0]) * n[1] * n[2];
  const CellSums mine = sum_cells(scene, simulation);
  if (ranks.is_root()) measure_solids_at_start(scene, simulation, size);
  std::array<double, 8> sums{mine.fluid,   mine.near,   mine.band,        size.nodes,
                             size.factors, size.facets, size.solid_bytes, size.solid_speed};
  ranks.global_sum(sums);
  size.fluid = sums[0];
  size.near = sums[1];
  size.band = sums[2];
  if (has_inflow(scene)) size.near = std::min(size.cells, size.near + inflow_share * size.cells);
  size.fall = simulation.start_account().liquid.fall;
  size.nodes = sums[3];
  size.factors = sums[4];
  size.facets = sums[5];
  size.solid_bytes = sums[6];
  size.solid_speed = sums[7];
  size.feed_speed = speed_of_feeds(scene);
  size.speed = simulation.stats().max_speed;
  return size;
}

namespace {

// True if steps are planned: each a whole share of the time to the next frame, and at most a quarter longer than the
// one before (step_size.cpp).
bool plans_steps(const Scene& scene) {
  return std::any_of(scene.solids.begin(), scene.solids.end(), [](const SolidSpec& s) { return s.kind.has_elements; });
}

// Longest step that the flow allows, s: cfl h / speed, and stable waves of gravity and tension (step_size.cpp).
double expected_step(const Scene& scene, const RunSize& size) {
  if (scene.time.fixed_step) return *scene.time.fixed_step;
  const double h = scene.domain.cell_size, g = Gravity(scene.gravity).largest(0, scene.time.end);
  const double speed =
      std::max({size.speed, size.feed_speed, 2 * std::sqrt(2 * g * size.fall)});  // jets: twice the mean
  double dt = 1 / scene.time.frame_rate;
  if (speed > 0) dt = std::min(dt, scene.time.cfl * h / speed);
  if (size.solid_speed > 0) dt = std::min(dt, h / size.solid_speed);
  if (g > 0) dt = std::min(dt, 1.5 * std::sqrt(h / (pi * g)));
  if (scene.liquid.surface_tension > 0 && scene.liquid.tension_scheme == TensionScheme::explicit_steps)
    dt = std::min(dt, std::sqrt(scene.liquid.density * h * h * h / (2 * pi * scene.liquid.surface_tension)));
  if (scene.time.max_step) dt = std::min(dt, *scene.time.max_step);
  return dt;
}

// Steps between two frames where steps are planned. They begin with a short one, sqrt(h/(8 g)), and grow by a quarter
// at most, so that from four to three steps a frame there is no way.
double planned_steps_a_frame(const Scene& scene, double dt) {
  constexpr double margin = 0.9, most_that_stay = 4;
  const double h = scene.domain.cell_size, g = Gravity(scene.gravity).largest(0, scene.time.end);
  const double wanted = std::ceil(1 / (scene.time.frame_rate * margin * dt) - 1e-9);
  if (g == 0) return wanted;
  const double at_first = std::ceil(1 / scene.time.frame_rate / std::sqrt(h / (8 * g)) - 1e-9);
  return std::max(wanted, std::min(at_first, most_that_stay));
}

// Number of steps; each frame's time ends one.
double expected_steps(const Scene& scene, double dt) {
  const double frames = std::max(0, last_frame(scene.time));
  const double a_frame = plans_steps(scene) && !scene.time.fixed_step
                             ? planned_steps_a_frame(scene, dt)
                             : std::ceil(1 / (scene.time.frame_rate * dt) - 1e-9);
  return std::max(std::ceil(scene.time.end / dt - 1e-9), frames * a_frame);
}

// Coefficients, in bytes, from runs of scenes/ and benchmarks/cases.py (docs/performance.md, "Estimates").
double expected_memory(const Scene& scene, const RunSize& size, int ranks) {
  constexpr double program = 117e6;  // a rank's libraries, threads and tables
  constexpr double body = 5e5;       // a free body in 3D
  constexpr double node = 1e4, factor = 4;
  double bytes = ranks * program + bytes_a_cell * size.cells + bytes_a_fluid_cell(scene) * size.near;
  for (const SolidSpec& solid : scene.solids) bytes += solid.kind.is_free() && scene.dimension == 3 ? body : 0;
  return bytes + node * size.nodes + factor * size.factors;
}

// One frame: level set and velocity as OpenVDB stores them, other fields, images for ParaView, and solids.
double expected_frame(const Scene& scene, const RunSize& size) {
  const bool flat = scene.dimension == 2;
  const auto wants = [](const std::vector<std::string>& list, const char* name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  double bytes = size.solid_bytes;
  int others = 0;  // scalar fields beside the surface
  for (const std::string& name : scene.output.frames)
    others += name != "surface" && name != "velocity" && name != "solids";
  const bool surface = wants(scene.output.frames, "surface"), velocity = wants(scene.output.frames, "velocity");
  if (wants(scene.output.formats, "vdb")) {
    const double tree = (flat ? 40e3 : 50e3) * size.near / (size.near + 200);  // of a grid that is not empty
    if (surface) bytes += tree + 4 * size.near;
    if (velocity) bytes += tree + (flat ? 14 : 10) * size.near;
    bytes += 3e3 + others * (tree / 2 + 4 * size.near);
  }
  if (wants(scene.output.formats, "vtk")) bytes += 4. / 3 * 4 * size.cells * (2 * surface + 3 * velocity + others);
  return bytes;
}

double expected_checkpoint(const Scene& scene, const RunSize& size) {
  const bool flat = scene.dimension == 2, viscous = has_viscous_flow(scene) || scene.gas.flows();
  const double a_cell = flat ? (viscous ? 160 : 115) : (viscous ? 230 : 170);
  return a_cell * size.near + 3 * 8 * 8 * size.nodes;
}

double expected_row_bytes(const Scene& scene) {
  return 340 + 240.0 * double(scene.solids.size()) + 200.0 * double(scene.joints.size()) +
         60.0 * double(scene.probes.size());
}

// Seconds of one core for a step of the liquid: a constant, and a share of each cell near it.
double expected_step_seconds(const RunSize& size) {
  constexpr double constant = 3e-3, near = 4.5e-6;
  return constant + near * size.near;
}

}  // namespace

RunEstimate estimate_run(const Scene& scene, const RunSize& size, int ranks, int threads,
                         const std::optional<TrialSteps>& trial) {
  RunEstimate e;
  e.frames = last_frame(scene.time) + 1;
  e.memory = std::max(expected_memory(scene, size, ranks), trial ? trial->memory : 0.0);
  e.frame_bytes = expected_frame(scene, size);
  e.checkpoint_bytes = 2 * expected_checkpoint(scene, size);
  const double steps = expected_steps(scene, expected_step(scene, size));
  e.steps = trial && trial->dt > 0 ? std::max(steps, expected_steps(scene, trial->dt)) : steps;
  e.table_bytes = e.steps * expected_row_bytes(scene);
  e.seconds = e.steps * (trial ? trial->seconds : expected_step_seconds(size) / (ranks * threads));
  return e;
}

std::vector<std::string> estimate_lines(const Scene& scene, const RunEstimate& e, int ranks, int threads,
                                        const std::optional<TrialSteps>& trial) {
  const std::string cores =
      fmt::format("{} rank{} of {} thread{}", ranks, ranks == 1 ? "" : "s", threads, threads == 1 ? "" : "s");
  std::vector<std::string> lines{
      fmt::format("memory  about {}", readable_bytes(e.memory)),
      fmt::format("disk    about {}: {} frames of {} (0 to {:g} s, {:g} a second), two checkpoints of {}, tables of {}",
                  readable_bytes(e.disk()), e.frames, readable_bytes(e.frame_bytes), scene.time.end,
                  scene.time.frame_rate, readable_bytes(e.checkpoint_bytes / 2), readable_bytes(e.table_bytes)),
      fmt::format("steps   about {:.0f}", e.steps)};
  if (trial)
    lines.push_back(fmt::format("time    about {} with {}, by {} trial step{} of {:.3g} s ({:.3g} to {:.3g} s)",
                                readable_seconds(e.seconds), cores, trial->steps, trial->steps == 1 ? "" : "s",
                                trial->seconds, trial->fastest, trial->slowest));
  else
    lines.push_back(
        fmt::format("time    {} or more with {}: a rough figure for the liquid alone; --measure 10 tries "
                    "steps",
                    readable_seconds(e.seconds), cores));
  return lines;
}

JsonMembers size_json(const RunSize& size) {
  return {{"cells", size.cells},           {"cells_with_fluid", size.fluid},
          {"cells_near_fluid", size.near}, {"cells_near_surface", size.band},
          {"elastic_nodes", size.nodes},   {"factor_bytes", size.factors},
          {"facets", size.facets},         {"solid_bytes_a_frame", size.solid_bytes}};
}

JsonMembers estimate_json(const RunEstimate& e, const std::optional<TrialSteps>& trial) {
  JsonMembers members{{"memory_bytes", e.memory},
                      {"frames", e.frames},
                      {"frame_bytes", e.frame_bytes},
                      {"checkpoint_bytes", e.checkpoint_bytes},
                      {"table_bytes", e.table_bytes},
                      {"disk_bytes", e.disk()},
                      {"steps", e.steps},
                      {"seconds", e.seconds}};
  if (trial)
    members.emplace_back("trial", JsonMembers{{"steps", trial->steps},
                                              {"seconds_a_step", trial->seconds},
                                              {"fastest", trial->fastest},
                                              {"slowest", trial->slowest},
                                              {"dt", trial->dt},
                                              {"memory_bytes", trial->memory}});
  return members;
}

}  // namespace seiche
