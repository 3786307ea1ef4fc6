// `seiche check`: examines a scene without running it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/agree.h"
#include "base/gravity.h"
#include "base/scene.h"
#include "fluid/rheology/rheology.h"
#include "geometry/shapes/shapes.h"
#include "run/command.h"
#include "run/loop.h"
#include "run/memory.h"
#include "run/mesh_extents.h"
#include "solid/elastic/solid.h"
#include "solid/mesh/point.h"

namespace seiche {
namespace {

// Rough number of cells that one core advances per second; measured on dam breaks.
constexpr double cells_a_core_second = 3e5;

// Grids up to this size are set up as for a run, within a few seconds.
constexpr std::int64_t most_cells_set_up = 2'000'000;

// Findings about the solids of a scene.
struct Verified {
  std::vector<std::string> notes, meshes, factors;
};

std::string describe_factors(const std::string& name, int dimension, int nodes) {
  return fmt::format("the factors of '{}' take about {}", name,
                     readable_bytes(factor_bytes(dimension, dimension * nodes)));
}

// The set-up for a run makes the shapes of sources and solids itself and tells their notes; doing it here as well would
// double the time.
std::vector<const ShapeSpec*> shapes_of(const Scene& scene, bool set_up) {
  std::vector<const ShapeSpec*> shapes;
  for (const auto& region : scene.liquid.regions) shapes.push_back(&region.shape);
  if (set_up) return shapes;
  for (const auto& source : scene.liquid.sources) shapes.push_back(&source.shape);
  for (const auto& drain : scene.liquid.drains) shapes.push_back(&drain.shape);
  for (const auto& solid : scene.solids) {
    if (!solid.kind.has_elements) shapes.push_back(&solid.shape);
  }
  return shapes;
}

// Meshes an elastic solid as a run would, and finds the points of its displacement probes.
template <int Dim>
void verify_elastic(const Scene& scene, const SolidSpec& solid, const ShapeOptions& options, Verified& found) {
  const Vec<Dim> lower = truncate<Dim>(scene.domain.lower), upper = truncate<Dim>(scene.domain.upper);
  const ElasticSolid<Dim> elastic = make_elastic_solid<Dim>(solid, options, lower, upper);
  for (const ProbeSpec& probe : scene.probes) {
    if (probe.kind == ProbeKind::displacement && probe.solid == solid.name)
      point_of_probe<Dim>(elastic.body.mesh, probe);
  }
  found.meshes.push_back(describe_mesh<Dim>(solid.name, elastic.body.mesh));
  found.factors.push_back(describe_factors(solid.name, Dim, elastic.body.size() / Dim));
}

template <int Dim>
void verify_shapes(const Scene& scene, bool set_up, Verified& found) {
  const ShapeOptions options{scene.domain.cell_size, &found.notes};
  for (const ShapeSpec* shape : shapes_of(scene, set_up)) make_shape<Dim>(*shape, options);
  for (const SolidSpec& solid : scene.solids) {
    if (solid.kind.has_elements && !set_up) verify_elastic<Dim>(scene, solid, options, found);
  }
}

Verified verify_solids(const Scene& scene, bool set_up) {
  Verified found;
  scene.dimension == 2 ? verify_shapes<2>(scene, set_up, found) : verify_shapes<3>(scene, set_up, found);
  return found;
}

// Speed of liquid that falls freely through the domain, sqrt(2 g H), m/s. 0 without gravity.
double fall_speed(const Scene& scene) {
  const Gravity gravity(scene.gravity);
  const Vec3 start = gravity.at(0);
  const double g = gravity.largest(0, scene.time.end), first = start.norm();
  const Vec3 extent = scene.domain.upper - scene.domain.lower;
  const double height = first > 0 ? std::abs(extent.dot(start)) / first : g > 0 ? extent.maxCoeff() : 0;
  return std::sqrt(2 * g * height);
}

// Number of steps dt = cfl h / speed, at least one a frame.
double expected_steps(const Scene& scene, double speed) {
  double dt = speed > 0 ? scene.time.cfl * scene.domain.cell_size / speed : 1 / scene.time.frame_rate;
  if (scene.time.max_step) dt = std::min(dt, *scene.time.max_step);
  if (scene.time.fixed_step) dt = *scene.time.fixed_step;
  return std::ceil(std::max({0.0, scene.time.end / dt, double(last_frame(scene.time))}));
}

std::string report(const Scene& scene, const Cost& cost, int ranks) {
  const auto& n = scene.domain.cells;
  const int frames = last_frame(scene.time) + 1;
  const double speed = fall_speed(scene), steps = expected_steps(scene, speed);
  const double seconds = steps * double(cost.cells) / (cells_a_core_second * ranks);
  // A frame holds at most a level set and three velocity components a cell, 4 bytes each.
  const double frame_bytes = 16.0 * double(cost.cells);
  std::string text = fmt::format("cells   {} ({} x {}", cost.cells, n[0], n[1]);
  if (scene.dimension == 3) text += fmt::format(" x {}", n[2]);
  text += fmt::format(")\nmemory  about {}\n", readable_bytes(cost.bytes));
  text += fmt::format("frames  {} (0 to {:g} s, {:g} a second), at most {} on disk\n", frames, scene.time.end,
                      scene.time.frame_rate, readable_bytes(frames * frame_bytes));
  text += fmt::format("steps   {} {:.0f}, {}\n", speed > 0 ? "about" : "at least", steps,
                      speed > 0 ? "if the liquid falls through the whole domain"
                                : "one a frame; without gravity it depends on how fast the liquid flows");
  return text + fmt::format("time    about {} on {} core{}, within a factor of three", readable_seconds(seconds), ranks,
                            ranks == 1 ? "" : "s");
}

// Description of the initial state.
struct Start {
  std::vector<std::string> lines, warnings;
};

// Sets up the initial state, which evaluates the formulas as a run would, and describes liquid and solids.
Start look_at_start(const Scene& scene, const Cost& cost, Verified& found, const Communicator& ranks) {
  if (cost.cells <= most_cells_set_up) {
    const std::unique_ptr<Simulation> simulation = make_simulation(scene, ranks);
    for (std::size_t k = 0; k < scene.solids.size(); ++k)
      if (scene.solids[k].kind.has_elements)
        found.factors.push_back(
            describe_factors(scene.solids[k].name, scene.dimension, int(simulation->solid_volume(k).rest.size())));
    Start start{simulation->describe_start(), found.notes};
    for (std::string& text : simulation->take_warnings())
      if (std::find(start.warnings.begin(), start.warnings.end(), text) == start.warnings.end())
        start.warnings.push_back(std::move(text));
    return start;
  }
  Start start{found.meshes, found.notes};
  start.lines.push_back(
      "note: the grid is too large to evaluate formulas and measure liquid and solids here; the run does it as it "
      "begins");
  return start;
}

}  // namespace

ExitCode check_command(const CheckOptions& options, const Surroundings& around) {
  RunLog log(around.ranks, around.console, Verbosity::normal);
  Scene scene;
  Verified found;
  Cost cost;
  agree(around.ranks, "checking the scene", [&] {
    scene = read_scene(options.scene, options.overrides);
    cost = estimate_cost(scene, around.ranks.size());
    check_memory(cost, 1, 1, machine_memory());
    std::vector<std::string> notes = check_mesh_extents(scene);
    found = verify_solids(scene, cost.cells <= most_cells_set_up);
    found.notes.insert(found.notes.begin(), notes.begin(), notes.end());
  });
  const Start start = look_at_start(scene, cost, found, around.ranks);
  for (const std::string& text : start.warnings) log.warn(text);
  log.note(fmt::format("{}: no errors", options.scene.string()));
  if (const std::string note = note_of_end(scene); !note.empty()) log.note(note);
  if (const std::string text = describe_rheology(scene.liquid.rheology); !text.empty()) log.note(text);
  for (const std::string& text : start.lines) log.note(text);
  for (const std::string& text : found.factors) log.note(text);
  log.note(report(scene, cost, around.ranks.size()));
  if (!found.factors.empty()) log.note("note: the estimated time covers the liquid only; elastic solids add to it");
  return ExitCode::done;
}

}  // namespace seiche
